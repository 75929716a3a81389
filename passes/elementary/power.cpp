// The real power and the cube root.
#include <limits>

#include "ir/infinity.h"
#include "passes/elementary/functions.h"
#include "passes/elementary/pieces.h"

namespace imp::elementary {
namespace {

// (3/2 log((1 + s)/(1 - s)) - 3 s - s^3)/s^5 in s^2 for |s| <= 0.1722, the log to 2^-36.7 and 2^-66.1.
constexpr double log_tail_f32[] = {0x1.333382p-1, 0x1.b67a2p-2, 0x1.67e082p-2};
constexpr double log_tail_f64[] = {0x1.3333333333474p-1, 0x1.b6db6db67fc7ep-2, 0x1.555555a4f7195p-2,
                                   0x1.1745ae5fe304bp-2, 0x1.d8aec5cb6cbb2p-3, 0x1.97367bd96a2c1p-3,
                                   0x1.95bdc88e4dd17p-3};

// ((1 + w)^(1/3) - 1)/w for |w| <= 2^-5 and 2^-9.5, the root to 2^-27.1 and 2^-65.9.
constexpr double root_f32[] = {0x1.555554p-2, -0x1.c73f5ep-4, 0x1.fa1c4ap-5};
constexpr double root_f64[] = {0x1.5555555555555p-2, -0x1.c71c71c71bccep-4, 0x1.f9add3c5d6d8ep-5,
                               -0x1.511eae873e6e4p-5, 0x1.ee2f7618de24fp-6};

// m^(1/3) for 1 <= m <= 8, to 2^-9.0 and 2^-11.8.
constexpr double guess_f32[] = {0x1.412cc8p-1, 0x1.cbf96cp-2, -0x1.572482p-4, 0x1.3a0adep-7, -0x1.c51722p-12};
constexpr double guess_f64[] = {0x1.1c7f244263d53p-1,  0x1.31fe1b04abd61p-1,  -0x1.8e82b30fb35adp-3,
                                0x1.8ae65dcf2ba7dp-5,  -0x1.d8031a5180b67p-8, 0x1.2e92fe2e77521p-11,
                                -0x1.3e6aa6a386e1fp-16};

// The multiple of 2^-10, 2^-25 next to or next but one to `x`, 1 <= x < 4: the upper half of its digits.
Expr upper_part(Expr x) {
  const double shift = x.type() == f32 ? 0x1.8p13 : 0x1.8p27;
  return (x + shift) - shift;
}

// A number as its upper half and the rest.
struct Split {
  Expr upper, lower;
};

// 3/2 log x for 0 < x < inf. With s = (m - 1)/(m + 1) for the m of take_apart it is
// 3/2 log 2^e + s (3 + s^2 + s^4 P(s^2)): s, the bracket and the products are sums of two numbers, all but
// the small s^4 P.
struct SplitLog {
  Expr rough;  // to a few digits, and -inf where x = 0
  Split value;
};

SplitLog split_log(Expr x) {
  const bool single = x.type() == f32;
  const auto [e, m] = take_apart(x);
  const Expr f = m - 1.0, denominator = f + 2.0;
  const Expr d_upper = upper_part(denominator), d_lower = f - (d_upper - 2.0);
  const Expr inverse = 1.0 / denominator;
  const Expr s = f * inverse;
  const Expr s_upper = upper_half(s);
  const Expr s_lower = ((f - s_upper * d_upper) - s_upper * d_lower) * inverse;

  const Expr square = s * s, upper_square = s_upper * s_upper;
  const Expr small =
      square * square * polynomial(square, table(x, log_tail_f32, log_tail_f64)) + (s + s_upper) * s_lower;
  const Expr b_upper = upper_part(3.0 + (upper_square + small));
  const Expr b_lower = small - ((b_upper - 3.0) - upper_square);

  // 3/2 log 2, the first with so few digits that its product with an exponent is exact
  const Expr exponents = e * (single ? 0x1.0a28p0 : 0x1.0a2b23f3ba8p0);
  const Sum sum = exact_sum(exponents, s_upper * b_upper);
  const Expr rest =
      sum.low + ((s_lower * b_upper + b_lower * s) + e * (single ? 0x1.91f9dep-15 : 0x1.b9b40d76ac6b2p-43));
  const Expr upper = upper_half(sum.high + rest);
  return {sum.high, {upper, rest - (upper - sum.high)}};
}

// 2/3 y, of which `upper` is the upper half; pays for the 3/2 of the logarithm.
Split two_thirds(Expr y) {
  const bool single = y.type() == f32;
  const double a_upper = single ? 0x1.554p-1 : 0x1.555555p-1;
  const double a_lower = single ? 0x1.555556p-13 : 0x1.5555555555555p-27;
  const Expr y_upper = upper_half(y);
  const Expr first = y_upper * a_upper;
  const Expr rest = (y - y_upper) * (2.0 / 3) + y_upper * a_lower;
  const Expr upper = upper_half(first + rest);
  return {upper, rest - (upper - first)};
}

}  // namespace

// e^(y log x) with the product to twice the precision, as its error counts 100 times and more in the
// power (after the pow of fdlibm, 1993). Where it is so large that the power is 0 or infinite, or an
// operand is, the product of the heads tells.
Expr pow(Expr x, Expr y) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto [rough, log] = split_log(x);
  const Split factor = two_thirds(y);
  const Expr small = factor.upper * log.lower + factor.lower * (log.upper + log.lower);
  const Sum product = exact_sum(factor.upper * log.upper, small);
  const Expr plain = y * select(x < infinity, rough, x);
  const Truth moderate = abs(plain) < (x.type() == f32 ? 192 : 1536);
  const Expr power =
      exp_of_sum({select(moderate, product.high, plain), select(moderate, product.low, zero(x))});
  const Truth unit = equal(x, one(x)) || equal(y, zero(y));
  return select(x >= 0 && equal(y, y), select(unit, one(x), power), constant_like(x, nan));
}

// x = 8^q m with 1 <= m < 8; a guess g at the root of m, with so few digits that g^3 is exact, and what is
// missing, w = (m - g^3)/g^3, made up for by the series of (1 + w)^(1/3).
Expr cbrt(Expr x) {
  const bool single = x.type() == f32;
  const Expr e = make(Op::exponent, x);
  const Expr q = floor((e + 0.5) * (1.0 / 3));
  const Expr m = make(Op::scale2, abs(x), q * -3.0);
  const double shift = single ? 0x1.8p16 : 0x1.8p36;
  const Expr guess = (polynomial(m, table(x, guess_f32, guess_f64)) + shift) - shift;
  const Expr cube = guess * guess * guess;
  const Expr w = (m - cube) / cube;
  const Expr root = guess + guess * w * polynomial(w, table(x, root_f32, root_f64));
  const Expr scaled = make(Op::scale2, select(x < 0, -root, root), q);
  return select(abs(e) < 2000, scaled, x);  // 0, infinities and NaN are their own roots
}

}  // namespace imp::elementary
