#include "passes/elementary/angle.h"

#include <limits>

#include "passes/elementary/bounds.h"
#include "passes/elementary/pieces.h"

namespace imp::elementary {
namespace {

// tools/coefficients_trigonometric.sollya makes these.

// (sin r - r)/r^3 in r^2 for |r| <= 0.79 and 0.7855, sin to 2^-27.8 and 2^-57.8.
constexpr double sine_f32[] = {-0x1.555544p-3, 0x1.1106d6p-7, -0x1.992462p-13};
constexpr double sine_f64[] = {-0x1.5555555555548p-3, 0x1.111111110f75dp-7,   -0x1.a01a019bf222ep-13,
                               0x1.71de355f05599p-19, -0x1.ae5e5471f54e4p-26, 0x1.5d8e3511cc1aap-33};

// (cos r - 1 + r^2/2)/r^4 in r^2, cos to 2^-32.8 and 2^-63.9.
constexpr double cosine_f32[] = {0x1.55554ap-5, -0x1.6c0c1ep-10, 0x1.99e334p-16};
constexpr double cosine_f64[] = {0x1.555555555554bp-5,   -0x1.6c16c16c15016p-10, 0x1.a01a019c8f3eep-16,
                                 -0x1.27e4f7f19d4b2p-22, 0x1.1ee9dbd0d86a6p-29,  -0x1.8fa681e38524p-37};

// (2 tan(r/2) - r)/r^3 in r^2, 2 tan(r/2) to 2^-28.7 and 2^-58.7.
constexpr double half_tangent_f32[] = {0x1.555538p-4, 0x1.111f22p-7, 0x1.b5ef36p-11, 0x1.a3c2fap-14};
constexpr double half_tangent_f64[] = {0x1.5555555555574p-4,  0x1.111111110d2dep-7,  0x1.ba1ba1bf877c4p-11,
                                       0x1.664f46a92ecffp-14, 0x1.226e908ee216cp-17, 0x1.d6beaf0570675p-21,
                                       0x1.7f232e8e464bdp-24, 0x1.25229d140c956p-27, 0x1.58b70a219c64ep-30};

// pi/2 as a sum. All but the last have so few digits that their products with the number of quarter turns
// of the largest angle are exact.
constexpr double quarter_turn_f32[] = {0x1.92p0, 0x1.fb4p-12, 0x1.444p-24, 0x1.68c234p-39};
constexpr double quarter_turn_f64[] = {0x1.921fb4p0, 0x1.4442dp-24, 0x1.84698p-48, 0x1.3198ap-69,
                                       0x1.701b839a25205p-92};

constexpr double two_over_pi = 0x1.45f306dc9c883p-1;

}  // namespace

// Cody & Waite, Software Manual for the Elementary Functions, 1980, chapter 8. The first two differences
// are exact in every rounding mode, as are the products but for the last; what further ones round away
// is found again (Dekker 1971): each part has digits as far down as the next product, or the difference is
// larger. The number of turns may be one off near its border: the rest is then a little larger. -0 stays in
// the head, as the excess is a difference of equals, +0.
Angle reduced(Expr x) {
  const auto part = table(x, quarter_turn_f32, quarter_turn_f64);
  const Expr nan = constant_like(x, std::numeric_limits<double>::quiet_NaN());
  const Expr known = select(abs(x) <= largest_angle(x.type()), x, nan);
  const Expr turns = floor(known * two_over_pi + 0.5);
  Expr head = known - turns * part[0] - turns * part[1];
  Expr excess = turns * part.back();
  for (const double more : part.subspan(2, part.size() - 3)) {
    const Expr product = turns * more, next = head - product;
    excess = next - head + product + excess;
    head = next;
  }

  const Expr half = turns * 0.5, pairs = floor(half);
  return {.rest = {head, excess},
          .square = head * head,
          .odd = pairs < half,
          .turned = floor(pairs * 0.5) < pairs * 0.5};
}

Expr sine(const Angle& angle) {
  const auto& [r, excess] = angle.rest;
  const Expr cubic = r * angle.square * polynomial(angle.square, table(r, sine_f32, sine_f64));
  return r - (excess - cubic);
}

// Only the last difference, and the one before by half as much, round visibly.
Expr cosine(const Angle& angle) {
  const auto& [r, excess] = angle.rest;
  const Expr quartic =
      angle.square * angle.square * polynomial(angle.square, table(r, cosine_f32, cosine_f64));
  return 1 - (angle.square * 0.5 - (quartic + r * excess));
}

Difference double_half_tangent(const Angle& angle) {
  const auto& [r, excess] = angle.rest;
  const Expr cubic =
      r * angle.square * polynomial(angle.square, table(r, half_tangent_f32, half_tangent_f64));
  const Expr rest = excess - cubic;
  const Expr head = r - rest;
  return {head, head - r + rest};
}

// The products with the short result are exact, and so is the first difference. What is missing is added:
// in denormals, rounded upward, the result is then the exact one rounded upward, and not 0.
Sum quotient(Difference numerator, Difference denominator, Expr reciprocal) {
  const Expr high = upper_half(numerator.head * reciprocal);
  const Expr upper = upper_half(denominator.head), lower = denominator.head - upper;
  const Expr missing =
      numerator.head - high * upper - high * lower + (high * denominator.excess - numerator.excess);
  return {high, missing * reciprocal};
}

HalfPi half_pi(Type type) {
  return type == f32 ? HalfPi{0x1.921fb6p0, -0x1.777a5cp-25}
                     : HalfPi{0x1.921fb54442d18p0, 0x1.1a62633145c07p-54};
}

}  // namespace imp::elementary
