// What each op computes, on the host: the last column of ir/ops.def made executable. The rounding
// mode is the caller's; compile callers with -frounding-math.
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

#include "ir/addition_chain.h"
#include "ir/assert.h"
#include "ir/chebyshev.h"
#include "ir/op.h"

namespace imp::meaning {

template <class T>
T sign(T a) {
  return a > 0 ? T(1) : a < 0 ? T(-1) : a;
}

// Rounded at each of its three ops.
template <class T>
T mod(T a, T b) {
  return a - b * std::floor(a / b);
}

// a^n by the products of ir/addition_chain.h, each rounded; 1/a^-n for n < 0; for n = 0 it is 1, but NaN
// at NaN. `n` is a constant integer of magnitude at most 2^20.
template <class T>
T powi(T a, T n) {
  const auto magnitude = static_cast<std::uint32_t>(std::abs(n));
  if (magnitude == 0) return std::isnan(a) ? a : T(1);
  const T power = positive_power(a, magnitude, [](T left, T right) { return left * right; });
  return n < 0 ? T(1) / power : power;
}

// The derivative of order `order` of the Chebyshev polynomial T_n, by the doublings of ir/chebyshev.h. `n`
// and `order` are constant integers, 0 <= order <= n <= 2^20, order <= 8; NaN for others, and at NaN. For
// |x| <= 1, T_n is off by at most n^2 ulps of 1.
template <class T>
T chebyshev(T x, T n, T order) {
  const bool legal = 0 <= order && order <= n && n <= T(largest_chebyshev_degree);
  if (!legal || order > T(largest_chebyshev_order) || std::isnan(x))
    return std::numeric_limits<T>::quiet_NaN();
  return imp::chebyshev(x, static_cast<unsigned>(n), static_cast<unsigned>(order),
                        [](double c) { return static_cast<T>(c); });
}

// The real power: NaN for a < 0 and where an operand is NaN, else as IEEE 754 pow, but that -0 is 0.
template <class T>
T pow(T a, T b) {
  return a >= 0 && !std::isnan(b) ? std::pow(std::abs(a), b) : std::numeric_limits<T>::quiet_NaN();
}

// floor(log2 |a|): -inf at 0, +inf at +-inf, NaN at NaN; true exponents for denormals.
template <class T>
T exponent(T a) {
  return std::logb(a);
}

// a * 2^floor(k), rounded once; k is first clamped to [-5000, 5000]; a NaN k gives NaN.
template <class T>
T scale2(T a, T k) {
  if (std::isnan(k)) return k;
  const T clamped = k < T(-5000) ? T(-5000) : k > T(5000) ? T(5000) : k;
  return std::scalbn(a, static_cast<int>(std::floor(clamped)));
}

// The value of a real, elementary or upward op. Unused operands are ignored.
template <class T>
T real([[maybe_unused]] Op op, [[maybe_unused]] T a, [[maybe_unused]] T b, [[maybe_unused]] T c) {
#define IMP_MEANING_real(name, text) \
  case Op::name: return text;
#define IMP_MEANING_elementary(name, text) IMP_MEANING_real(name, text)
#define IMP_MEANING_upward(name, text) IMP_MEANING_real(name, text)
#define IMP_MEANING_compare(name, text)
#define IMP_MEANING_logic(name, text)
#define IMP_MEANING_choice(name, text)
#define IMP_MEANING_convert(name, text)
#define IMP_MEANING_packet(name, text)
#define IMP_MEANING_structure(name, text)
  switch (op) {
#define OP(name, arity, kind, llvm, glsl, text) IMP_MEANING_##kind(name, text)
#include "ir/ops.def"
    default: break;
  }
#undef IMP_MEANING_real
#define IMP_MEANING_real(name, text)
  IMP_ASSERT(false, "an op on numbers");
  return a;
}

// The value of a comparison (T a number) or of a logic op (T = bool).
template <class T>
bool truth([[maybe_unused]] Op op, T a, [[maybe_unused]] T b) {
  switch (op) {
#undef IMP_MEANING_elementary
#undef IMP_MEANING_upward
#undef IMP_MEANING_compare
#undef IMP_MEANING_logic
#define IMP_MEANING_elementary(name, text)
#define IMP_MEANING_upward(name, text)
#define IMP_MEANING_compare(name, text) \
  case Op::name: return text;
#define IMP_MEANING_logic(name, text)                   \
  case Op::name:                                        \
    if constexpr (std::is_same_v<T, bool>) return text; \
    break;
#define OP(name, arity, kind, llvm, glsl, text) IMP_MEANING_##kind(name, text)
#include "ir/ops.def"
    default: break;
  }
#undef IMP_MEANING_real
#undef IMP_MEANING_elementary
#undef IMP_MEANING_upward
#undef IMP_MEANING_compare
#undef IMP_MEANING_logic
#undef IMP_MEANING_choice
#undef IMP_MEANING_convert
#undef IMP_MEANING_packet
#undef IMP_MEANING_structure
  IMP_ASSERT(false, "a comparison or a logic op");
  return false;
}

}  // namespace imp::meaning
