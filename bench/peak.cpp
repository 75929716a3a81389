#include "bench/peak.h"

#include <immintrin.h>

#include <algorithm>

#include "bench/clocks.h"

namespace imp::bench {
namespace {

constexpr int chains = 12;  // in flight: more than latency times throughput on processors of today
constexpr int steps = 1 << 16;

__attribute__((target("avx2,fma"))) float chains_of_8(float seed) {
  __m256 sums[chains];
#pragma GCC unroll 12
  for (int i = 0; i < chains; ++i) sums[i] = _mm256_set1_ps(seed + static_cast<float>(i));
  const __m256 factor = _mm256_set1_ps(0.999f), term = _mm256_set1_ps(1e-3f);
  for (int k = 0; k < steps; ++k) {
#pragma GCC unroll 12
    for (__m256& sum : sums) sum = _mm256_fmadd_ps(sum, factor, term);
  }
#pragma GCC unroll 12
  for (int i = 1; i < chains; ++i) sums[0] = _mm256_add_ps(sums[0], sums[i]);
  return _mm256_cvtss_f32(sums[0]);
}

__attribute__((target("avx512f"))) float chains_of_16(float seed) {
  __m512 sums[chains];
#pragma GCC unroll 12
  for (int i = 0; i < chains; ++i) sums[i] = _mm512_set1_ps(seed + static_cast<float>(i));
  const __m512 factor = _mm512_set1_ps(0.999f), term = _mm512_set1_ps(1e-3f);
  for (int k = 0; k < steps; ++k) {
#pragma GCC unroll 12
    for (__m512& sum : sums) sum = _mm512_fmadd_ps(sum, factor, term);
  }
#pragma GCC unroll 12
  for (int i = 1; i < chains; ++i) sums[0] = _mm512_add_ps(sums[0], sums[i]);
  return _mm512_cvtss_f32(sums[0]);
}

}  // namespace

double peak_a_cycle() { return __builtin_cpu_supports("avx512f") != 0 ? 64 : 32; }

double peak_gflops(bool widest) {
  const bool wide = widest && __builtin_cpu_supports("avx512f") != 0;
  if (!wide && !__builtin_cpu_supports("fma")) return 0;
  const double operations = 2.0 * chains * steps * (wide ? 16 : 8);
  double best = 0;
  volatile float sink = 1;
  for (const ThreadClock all; all.milliseconds() < 20;) {
    const ThreadClock clock;
    sink = wide ? chains_of_16(sink) : chains_of_8(sink);
    best = std::max(best, operations / (clock.milliseconds() * 1e6));
  }
  return best;
}

}  // namespace imp::bench
