// e^x and what is made of it: x = k log 2 + r with |r| <= log(2)/2, and a polynomial in r (Cody & Waite,
// Software Manual for the Elementary Functions, 1980).
#include <optional>

#include "passes/elementary/functions.h"
#include "passes/elementary/pieces.h"

namespace imp::elementary {
namespace {

// (e^r - 1 - r)/r^2 for |r| <= 0.348, e^r to 2^-28.2 and 2^-57.8.
constexpr double exp_f32[] = {0x1.fffffcp-2, 0x1.55548ep-3, 0x1.5558ap-5, 0x1.123c56p-7, 0x1.6a62e6p-10};
constexpr double exp_f64[] = {0x1.000000000000ap-1,  0x1.55555555554f7p-3,  0x1.55555555505e3p-5,
                              0x1.1111111128422p-7,  0x1.6c16c184c1fd3p-10, 0x1.a01a012897abdp-13,
                              0x1.a01998608d336p-16, 0x1.71df26d3d7d74p-19, 0x1.28af0b86c84dap-22,
                              0x1.ad80eacbbf91p-26};

// (sinh x - x)/x^3 in x^2 for |x| <= 0.75, sinh to 2^-28.4 and 2^-58.9.
constexpr double sinh_f32[] = {0x1.555562p-3, 0x1.1108b6p-7, 0x1.a66d7cp-13};
constexpr double sinh_f64[] = {0x1.555555555554ep-3,  0x1.11111111120cap-7,  0x1.a01a019d47e14p-13,
                               0x1.71de3e101f13cp-19, 0x1.ae5f59b5fa699p-26, 0x1.646bf440857cfp-33};

// (x - tanh x)/x^3 in x^2 for |x| <= 1 and 0.6875, tanh to 2^-27.6 and 2^-57.9.
constexpr double tanh_f32[] = {0x1.55553cp-2, -0x1.110be6p-3, 0x1.b96288p-5, -0x1.600bd6p-6,
                               0x1.04675p-7,  -0x1.2db79ep-9, 0x1.7806d8p-12};
constexpr double tanh_f64[] = {0x1.5555555555537p-2,   -0x1.111111110eee5p-3,  0x1.ba1ba1b86c574p-5,
                               -0x1.664f482d2a214p-6,  0x1.226e2b614dc67p-7,   -0x1.d6d253396c50dp-9,
                               0x1.7d9049513274p-10,   -0x1.34af9c8cd378ep-11, 0x1.ed6bb57c2373ap-13,
                               -0x1.74519d2b7b676p-14, 0x1.cf1496a984a64p-16,  -0x1.4f24e5db6234ap-18};

// e^x = 2^k (1 + r + rest), r exact.
struct Exponential {
  Expr k, r, rest;
};

Exponential exponential(Expr x, std::optional<Expr> low = {}) {
  const Log2 log2 = log_of_2(x.type());
  const Expr k = floor(x * 0x1.71547652b82fep0 + 0.5);
  const Expr r = x - k * log2.high;
  const Expr left = low ? k * log2.low - *low : k * log2.low;
  const Expr reduced = r - left;
  const Expr curved = reduced * reduced * polynomial(reduced, table(x, exp_f32, exp_f64));
  return {k, r, curved - left};
}

// e^x, where it neither overflows nor is denormal, as 2^k times a sum: what is made of it pays for one
// rounding only.
struct ExponentialSum {
  Expr k;
  Sum value;
};

ExponentialSum exponential_sum(Expr x) {
  const Exponential e = exponential(x);
  const Sum linear = exact_sum(one(x), e.r);
  return {e.k, {linear.high, linear.low + e.rest}};
}

Expr finished_exp(Expr x, std::optional<Expr> low) {
  const bool single = x.type() == f32;
  const Exponential e = exponential(min(constant_like(x, single ? 89 : 710), x), low);
  const Expr value = make(Op::scale2, 1.0 + (e.r + e.rest), e.k);
  return select(x < (single ? -104 : -745.2), zero(x), value);
}

// e^a/4 and e^-a/4 for a >= 0, up to where e^a/2 overflows.
struct Quarters {
  Sum up;
  Expr down;
};

Quarters quarters(Expr a) {
  const ExponentialSum e = exponential_sum(min(constant_like(a, a.type() == f32 ? 89.6 : 710.6), a));
  const Expr power = make(Op::scale2, one(a), e.k - 2.0);
  const Sum up{e.value.high * power, e.value.low * power};
  return {up, 0.0625 / (up.high + up.low)};
}

}  // namespace

Expr exp(Expr x) { return finished_exp(x, {}); }
Expr exp_of_sum(Sum x) { return finished_exp(x.high, x.low); }

// (e^a - e^-a)/2, or a polynomial for |x| < 3/4, where each of the two loses a little less than beyond.
Expr sinh(Expr x) {
  const Expr a = abs(x), square = x * x;
  const auto [up, down] = quarters(a);
  const Expr half = up.high + (up.low - down);
  const Expr near_zero = a + a * square * polynomial(square, table(x, sinh_f32, sinh_f64));
  return odd(x, select(a < 0.75, near_zero, half * 2.0), 0x1p-30);
}

Expr cosh(Expr x) {
  const auto [up, down] = quarters(abs(x));
  return (up.high + (up.low + down)) * 2.0;
}

// 1 - 2/(e^2a + 1), divided by e^2a = head/q, where that has no digits to lose; else a polynomial.
Expr tanh(Expr x) {
  const bool single = x.type() == f32;
  const Expr a = abs(x), square = x * x;
  const Expr capped = min(constant_like(a, single ? 10 : 20), a);
  const auto [k, e] = exponential_sum(capped * 2.0);
  const Expr q = make(Op::scale2, one(x), -k);
  const Expr far = 1.0 - q * 2.0 / (e.high + (e.low + q));
  const Expr near_zero = a - a * square * polynomial(square, table(x, tanh_f32, tanh_f64));
  return odd(x, select(a < (single ? 1 : 0.6875), near_zero, far), single ? 0x1p-13 : 0x1p-28);
}

}  // namespace imp::elementary
