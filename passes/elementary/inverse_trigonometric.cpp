// The inverse functions of the angles. Arguments are brought to where a polynomial is short, by
// asin x = pi/2 - 2 asin sqrt((1 - x)/2) and atan x = pi/2 - atan 1/x (Cody & Waite, Software Manual for
// the Elementary Functions, 1980, chapters 10 and 11). Sums are ordered such that only the last one rounds
// by a whole ulp, and such that where all ops round upward their errors cancel.
#include <limits>

#include "passes/elementary/angle.h"
#include "passes/elementary/functions.h"
#include "passes/elementary/pieces.h"

namespace imp::elementary {
namespace {

// tools/coefficients_trigonometric.sollya makes these.

// (asin x - x)/x^3 in x^2 for |x| <= 1/2, asin to 2^-27.6 and 2^-55.9.
constexpr double arcsine_f32[] = {0x1.5555c8p-3, 0x1.330206p-4, 0x1.747b72p-5, 0x1.8c415ap-6, 0x1.5959aap-5};
constexpr double arcsine_f64[] = {0x1.555555555539p-3,  0x1.333333336e80fp-4,  0x1.6db6db427a4f8p-5,
                                  0x1.f1c72c38fb343p-6, 0x1.6e89f44019769p-6,  0x1.1c6be1a687d83p-6,
                                  0x1.c6fdc1aa99fb6p-7, 0x1.8ec2fca664948p-7,  0x1.abcf5cd3c582p-8,
                                  0x1.3ff4a993e8f23p-6, -0x1.09d328395e2acp-6, 0x1.056d6c8369ac4p-5};

// (atan x - x)/x^3 in x^2 for |x| <= 1, atan to 2^-28.5 and 2^-57.5.
constexpr double arctangent_f32[] = {-0x1.55553ep-2, 0x1.9991ecp-3,  -0x1.24211ap-3,
                                     0x1.c0946cp-4,  -0x1.5825f2p-4, 0x1.da9c2ep-5,
                                     -0x1.fe7d24p-6, 0x1.6551e2p-7,  -0x1.d5a1aap-10};
constexpr double arctangent_f64[] = {
    -0x1.5555555555526p-2, 0x1.99999999955b4p-3,  -0x1.249249237f57dp-3,  0x1.c71c717fcf76cp-4,
    -0x1.745d11ae74c4cp-4, 0x1.3b13669a29c9ap-4,  -0x1.110e5126fa3b8p-4,  0x1.e1bba66bedb2p-5,
    -0x1.ae5e72bfe9e67p-5, 0x1.82dad798fe0acp-5,  -0x1.59a3ff1e0359cp-5,  0x1.2c2e5cb19de41p-5,
    -0x1.e9fa0d38f10fep-6, 0x1.683cc8eceb055p-6,  -0x1.c78fcc1616993p-7,  0x1.d7b925caa4892p-8,
    -0x1.7a3998a3a2487p-9, 0x1.b3fac8704d47dp-11, -0x1.3f364a25134c3p-13, 0x1.bbed9a0d9d2e7p-17};

// asin t - t for |t| <= 1/2, of which z is the square.
Expr arcsine_tail(Expr t, Expr z) { return t * z * polynomial(z, table(t, arcsine_f32, arcsine_f64)); }

// atan t - t for |t| <= 1.
Expr arctangent_tail(Expr t) {
  const Expr z = t * t;
  return t * z * polynomial(z, table(t, arctangent_f32, arctangent_f64));
}

// The argument of the polynomial of asin and acos: x, or sqrt((1 - |x|)/2) where |x| > 1/2, the root of
// an exact number; NaN where |x| > 1.
struct ArcsineArgument {
  Truth beyond;
  Expr square, root, tail;
};

ArcsineArgument arcsine_argument(Expr x) {
  const Expr size = abs(x);
  const Truth beyond = size > 0.5;
  const Expr square = select(beyond, (1 - size) * 0.5, x * x);
  const Expr root = select(beyond, sqrt(square), x);
  return {beyond, square, root, arcsine_tail(root, square)};
}

}  // namespace

// Beyond 1/2: pi/4 + (pi/4 - 2 s) - 2 (asin s - s), s the root.
Expr asin(Expr x) {
  const auto [beyond, square, root, tail] = arcsine_argument(x);
  const HalfPi half = half_pi(x.type());
  const Expr quarter = constant_like(x, half.high / 2);
  const Expr value = quarter - ((tail * 2 - half.low) - (quarter - root * 2));
  return select(beyond, select(x < 0, -value, value), x + tail);
}

// pi/2 - asin x; beyond 1/2 twice asin s or pi/2 - asin s, where s needs the digits its root rounded away:
// s = h + (s^2 - h^2)/(s + h), h its upper half.
Expr acos(Expr x) {
  const auto [beyond, square, root, tail] = arcsine_argument(x);
  const HalfPi half = half_pi(x.type());
  const Expr upper = upper_half(root);
  const Expr tiny = constant_like(x, x.type() == f32 ? 0x1p-100 : 0x1p-1000);
  const Expr lower = (square - upper * upper) / make(Op::max, tiny, root + upper);

  const Expr head = select(beyond, upper, x), rest = select(beyond, lower + tail, tail);
  const Expr from_right = half.high - (head + (rest - half.low));
  return select(beyond, select(x < 0, from_right, head + rest) * 2, from_right);
}

// Beyond 1: pi/4 + (pi/4 - 1/x) - (atan 1/x - 1/x), with the sign of x.
Expr atan(Expr x) {
  const HalfPi half = half_pi(x.type());
  const auto with_sign = [&](double c) { return select(x < 0, constant_like(x, -c), constant_like(x, c)); };
  const Truth beyond = abs(x) > 1;
  const Expr inverse = 1 / x;
  const Expr tail = arctangent_tail(select(beyond, inverse, x));
  const Expr quarter = with_sign(half.high / 2);
  const Expr rest = tail - with_sign(half.low) - (quarter - inverse);
  return select(beyond, quarter, x) - select(beyond, rest, 0 - tail);
}

// The smaller of |y| and |x| over the larger, to more digits than the type has: an arc of at most pi/4,
// and the angle is a quarter or half a turn less or more that arc.
Expr atan2(Expr y, Expr x) {
  const Type type = x.type();
  const HalfPi half = half_pi(type);
  const auto constant = [&](double c) { return constant_like(x, c); };
  const double largest = type == f32 ? std::numeric_limits<float>::max() : std::numeric_limits<double>::max();

  const Truth steep = abs(y) > abs(x);
  const Expr least = select(steep, abs(x), abs(y)), most = select(steep, abs(y), abs(x));

  // Two infinities are as two ones, and what is less than one as 0; NaN stays.
  const Truth infinite = most > largest;
  const Expr finite_least = select(infinite, select(equal(least, most), one(x), least * 0), least);
  const Expr finite_most = select(infinite, one(x), most);

  // Far from the ends of the range, so that no product in the quotient leaves it where that is normal.
  const auto power = [&](double for_f32, double for_f64) {
    return constant(type == f32 ? for_f32 : for_f64);
  };
  const Expr scale =
      select(finite_most < power(0x1p40, 0x1p400), power(0x1p60, 0x1p500), power(0x1p-30, 0x1p-200));
  const Expr denominator = make(Op::max, power(0x1p-100, 0x1p-600), finite_most * scale);

  // The sign of a zero shows in its inverse only. Where y = 0 the quotient needs none. A little less than
  // the inverse, lest a denormal quotient rounded upward is 0.
  const Truth level = equal(y, zero(y));
  const Expr inverse = power(1 - 0x1p-21, 1 - 0x1p-50) / select(level, y, denominator);
  const Expr reciprocal = select(level, zero(x), inverse);
  const Truth below = y < 0 || inverse < 0, left = x < 0 || 1 / x < 0;

  const Sum ratio = quotient({finite_least * scale, zero(x)}, {denominator, zero(x)}, reciprocal);
  const Expr rest = arctangent_tail(ratio.high + ratio.low) + ratio.low;

  const Truth less = (steep && !left) || (!steep && left);
  const auto turns = [&](double quarter) {
    return select(steep, constant(quarter), select(left, constant(2 * quarter), zero(x)));
  };
  const Expr arc = select(less, ratio.high, -ratio.high) + (select(less, rest, -rest) - turns(half.low));
  const Expr angle = turns(half.high) - arc;
  return select(below, -angle, angle);
}

}  // namespace imp::elementary
