// log x and what is made of it: x = 2^e (1 + f), s = f/(2 + f), and a polynomial in s^2, as
// log(1 + f) = log((1 + s)/(1 - s)) = f - f^2/2 + s (f^2/2 + s^2 P(s^2)), whose terms shrink fast enough
// for the errors of s not to matter (K. C. Ng's log of fdlibm, 1993).
#include <limits>
#include <optional>

#include "ir/infinity.h"
#include "passes/elementary/functions.h"
#include "passes/elementary/pieces.h"

namespace imp::elementary {
namespace {

// (log((1 + s)/(1 - s)) - 2 s)/s^3 in s^2 for |s| <= 0.1722, log to 2^-30.1 and 2^-59.3.
constexpr double log_f32[] = {0x1.55557ap-1, 0x1.995e9p-2, 0x1.31ece2p-2};
constexpr double log_f64[] = {0x1.5555555555596p-1, 0x1.999999997e934p-2, 0x1.2492494324ffep-2,
                              0x1.c71c5100edb8dp-3, 0x1.746678055652cp-3, 0x1.399bb194044d7p-3,
                              0x1.2f44eb7852a55p-3};

// (atanh s - s)/s^3 in s^2 for |s| <= 0.335, atanh to 2^-32.9 and 2^-58.
constexpr double atanh_f32[] = {0x1.555558p-2, 0x1.9996dp-3, 0x1.25069cp-3, 0x1.b6fd3p-4, 0x1.f164fp-4};
constexpr double atanh_f64[] = {0x1.5555555555532p-2, 0x1.99999999a10dep-3, 0x1.249249203ab3fp-3,
                                0x1.c71c74469cb2p-4,  0x1.745cade645bf1p-4, 0x1.3b1e62fe642ddp-4,
                                0x1.10609001a4bfbp-4, 0x1.f04dfc37797e4p-5, 0x1.53a029635cb9ep-5,
                                0x1.5e6f9b497a6adp-4};

// log(2^e (1 + f)) for |s| as above; `low` is what 1 + f lacks, much smaller.
Expr log_of_parts(Expr e, Expr f, std::optional<Expr> low = {}) {
  const Log2 log2 = log_of_2(f.type());
  const Expr s = f / (f + 2.0);
  const Expr square = s * s, half = f * f * 0.5;
  Expr rest = e * log2.low + s * (half + square * polynomial(square, table(f, log_f32, log_f64)));
  if (low) rest = rest + *low * (1.0 - s * 2.0);  // low/(1 + f), roughly
  return e * log2.high + (f - (half - rest));
}

// log(2 (half.high + half.low)) for a number from 1 up.
Expr log_of_twice(Sum half) {
  const Expr e = make(Op::exponent, half.high);
  const Expr power = make(Op::scale2, one(e), 1.0 - e);  // twice what is needed, to be no denormal
  const Expr twice = half.high * power;
  const Truth large = twice > 0x1.6a09e6p1;
  const Expr factor = select(large, constant_like(e, 0.25), constant_like(e, 0.5));
  return log_of_parts(select(large, e + 2.0, e + 1.0), twice * factor - 1.0, half.low * power * factor);
}

}  // namespace

Expr log(Expr x) {
  const auto [e, m] = take_apart(x);
  return on_positive(x, log_of_parts(e, m - 1.0));
}

// log(1 + a + (sqrt(a^2 + 1) - 1)); for large a log(2a), which lacks 1/(4 a^2).
Expr asinh(Expr x) {
  const bool single = x.type() == f32;
  const Expr a = abs(x), half = a * 0.5;
  const Expr above_1 = half * (a / (sqrt(a * a + 1.0) + 1.0));
  const Expr center = constant_like(a, 0.5);
  const Sum linear = exact_sum(max(center, half), min(center, half));
  const Sum all = exact_sum(linear.high, above_1);
  const Truth large = a > (single ? 0x1p10 : 0x1p27);
  const Sum near{select(large, a, all.high), select(large, zero(a), linear.low + all.low)};
  const Truth finite = a < infinity;
  return odd(x, select(finite, log_of_twice(near), a), single ? 0x1p-12 : 0x1p-27);
}

// log(1 + t + sqrt(2t + t^2)), t = x - 1; the root with the error of its argument and its own, as near 1
// it is all there is. Where x^2 - 1 = x^2, log(2x).
Expr acosh(Expr x) {
  const bool single = x.type() == f32;
  const Expr t = x - 1.0;
  const Sum square = exact_sum(t * 2.0, t * t);
  const Expr root = sqrt(square.high);
  const Expr upper = upper_half(root), lower = root - upper;
  const Expr missing = ((square.high - upper * upper) - upper * 2.0 * lower) - lower * lower;
  const Expr correction = (missing + square.low) / max(constant_like(x, 0x1p-30), root * 2.0);
  const Expr small = min(one(x), t), big = max(one(x), t);
  const Sum linear = exact_sum(big, small);
  const Sum all = exact_sum(linear.high, root);
  const Truth large = x > (single ? 0x1p13 : 0x1p28);
  const Expr low = (linear.low + all.low) + correction;
  const Sum near{select(large, x, all.high * 0.5), select(large, zero(x), low * 0.5)};
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  return select(x < infinity, select(x < 1, constant_like(x, nan), log_of_twice(near)), x);
}

// log((1 + a)/(1 - a))/2 = k log(2)/2 + atanh s, where 2^k (1 - a) lies near 1 + a and s is their
// difference by their sum; for small a that is k = 0, s = a.
Expr atanh(Expr x) {
  const bool single = x.type() == f32;
  const Expr a = abs(x);
  const Sum up = exact_sum(one(x), a), down = exact_sum(one(x), -a);
  const Expr far = -make(Op::exponent, down.high);
  const Expr power = make(Op::scale2, one(x), min(far, constant_like(x, 64)));
  const Expr scaled = down.high * power;
  const Expr difference = (up.high - scaled) + (up.low - down.low * power);
  const Truth near = a < 0.2875;
  const Expr k = select(near, zero(x), far);
  const Expr s = select(near, a, difference / (up.high + scaled));
  const Expr square = s * s;
  const Log2 log2 = log_of_2(x.type());
  const Expr curved = s * square * polynomial(square, table(x, atanh_f32, atanh_f64));
  const Expr value = k * (log2.high / 2) + (s + (curved + k * (log2.low / 2)));
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  return odd(x, select(a <= 1, value, constant_like(x, nan)), single ? 0x1p-12 : 0x1p-27);
}

}  // namespace imp::elementary
