// Sine, cosine and tangent: from the reduced angle (angle.h), which they share where their argument is
// the same.
#include "passes/elementary/angle.h"
#include "passes/elementary/functions.h"

namespace imp::elementary {

Expr sin(Expr x) {
  const Angle angle = reduced(x);
  const Expr value = select(angle.odd, cosine(angle), sine(angle));
  return select(angle.turned, -value, value);
}

Expr cos(Expr x) {
  const Angle angle = reduced(x);
  const Expr value = select(angle.odd, -sine(angle), cosine(angle));
  return select(angle.turned, -value, value);
}

// With t = 2 tan(r/2), whose polynomial is short: tan r = t/(1 - t^2/4), and after an odd number of quarter
// turns -1/tan r.
Expr tan(Expr x) {
  const Angle angle = reduced(x);
  const Difference t = double_half_tangent(angle);
  const Expr half = t.head * 0.5, square = half * half;
  const Expr head = 1 - square;
  const Difference d{head, head - 1 + square - half * t.excess};

  const Difference numerator{select(angle.odd, -d.head, t.head), select(angle.odd, -d.excess, t.excess)};
  const Difference denominator{select(angle.odd, t.head, d.head), select(angle.odd, t.excess, d.excess)};
  const Sum q = quotient(numerator, denominator, 1 / denominator.head);
  return select(abs(x) < (x.type() == f32 ? 0x1p-13 : 0x1p-28), x, q.high + q.low);
}

}  // namespace imp::elementary
