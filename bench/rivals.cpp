#include "bench/rivals.h"

#include <immintrin.h>
#include <sleef.h>

namespace imp::bench {
namespace {

template <auto f>
void unary(std::size_t n, const float* x, const float*, float* result) {
  for (std::size_t i = 0; i < n; i += 8) _mm256_storeu_ps(result + i, f(_mm256_loadu_ps(x + i)));
}

template <auto f>
void binary(std::size_t n, const float* x, const float* y, float* result) {
  for (std::size_t i = 0; i < n; i += 8)
    _mm256_storeu_ps(result + i, f(_mm256_loadu_ps(x + i), _mm256_loadu_ps(y + i)));
}

}  // namespace

extern "C" {
__m256 _ZGVdN8v_expf(__m256);
__m256 _ZGVdN8v_logf(__m256);
__m256 _ZGVdN8v_cbrtf(__m256);
__m256 _ZGVdN8v_sinf(__m256);
__m256 _ZGVdN8v_cosf(__m256);
__m256 _ZGVdN8v_tanf(__m256);
__m256 _ZGVdN8v_asinf(__m256);
__m256 _ZGVdN8v_acosf(__m256);
__m256 _ZGVdN8v_atanf(__m256);
__m256 _ZGVdN8v_sinhf(__m256);
__m256 _ZGVdN8v_coshf(__m256);
__m256 _ZGVdN8v_tanhf(__m256);
__m256 _ZGVdN8v_asinhf(__m256);
__m256 _ZGVdN8v_acoshf(__m256);
__m256 _ZGVdN8v_atanhf(__m256);
__m256 _ZGVdN8vv_powf(__m256, __m256);
__m256 _ZGVdN8vv_atan2f(__m256, __m256);
}

void sleef_sincos(std::size_t n, const float* x, float* sines, float* cosines) {
  for (std::size_t i = 0; i < n; i += 8) {
    const auto both = Sleef_sincosf8_u10avx2(_mm256_loadu_ps(x + i));
    _mm256_storeu_ps(sines + i, both.x);
    _mm256_storeu_ps(cosines + i, both.y);
  }
}

ArrayFunction sleef(Op op) {
  switch (op) {
    case Op::exp:   return unary<Sleef_expf8_u10avx2>;
    case Op::log:   return unary<Sleef_logf8_u10avx2>;
    case Op::cbrt:  return unary<Sleef_cbrtf8_u10avx2>;
    case Op::sin:   return unary<Sleef_sinf8_u10avx2>;
    case Op::cos:   return unary<Sleef_cosf8_u10avx2>;
    case Op::tan:   return unary<Sleef_tanf8_u10avx2>;
    case Op::asin:  return unary<Sleef_asinf8_u10avx2>;
    case Op::acos:  return unary<Sleef_acosf8_u10avx2>;
    case Op::atan:  return unary<Sleef_atanf8_u10avx2>;
    case Op::sinh:  return unary<Sleef_sinhf8_u10avx2>;
    case Op::cosh:  return unary<Sleef_coshf8_u10avx2>;
    case Op::tanh:  return unary<Sleef_tanhf8_u10avx2>;
    case Op::asinh: return unary<Sleef_asinhf8_u10avx2>;
    case Op::acosh: return unary<Sleef_acoshf8_u10avx2>;
    case Op::atanh: return unary<Sleef_atanhf8_u10avx2>;
    case Op::pow:   return binary<Sleef_powf8_u10avx2>;
    case Op::atan2: return binary<Sleef_atan2f8_u10avx2>;
    default:        return nullptr;
  }
}

ArrayFunction libmvec(Op op) {
  switch (op) {
    case Op::exp:   return unary<_ZGVdN8v_expf>;
    case Op::log:   return unary<_ZGVdN8v_logf>;
    case Op::cbrt:  return unary<_ZGVdN8v_cbrtf>;
    case Op::sin:   return unary<_ZGVdN8v_sinf>;
    case Op::cos:   return unary<_ZGVdN8v_cosf>;
    case Op::tan:   return unary<_ZGVdN8v_tanf>;
    case Op::asin:  return unary<_ZGVdN8v_asinf>;
    case Op::acos:  return unary<_ZGVdN8v_acosf>;
    case Op::atan:  return unary<_ZGVdN8v_atanf>;
    case Op::sinh:  return unary<_ZGVdN8v_sinhf>;
    case Op::cosh:  return unary<_ZGVdN8v_coshf>;
    case Op::tanh:  return unary<_ZGVdN8v_tanhf>;
    case Op::asinh: return unary<_ZGVdN8v_asinhf>;
    case Op::acosh: return unary<_ZGVdN8v_acoshf>;
    case Op::atanh: return unary<_ZGVdN8v_atanhf>;
    case Op::pow:   return binary<_ZGVdN8vv_powf>;
    case Op::atan2: return binary<_ZGVdN8vv_atan2f>;
    default:        return nullptr;
  }
}

}  // namespace imp::bench
