#include "passes/extend/half_lines.h"

#include "ir/infinity.h"

namespace imp {
namespace {

// By one end alone: the other one may be NaN.
Truth lies_above(const Interval& a) { return a.nlo < 0; }
Truth lies_below(const Interval& a) { return a.hi < 0; }

Interval negated(const Interval& a) { return {a.hi, a.nlo, a.empty, a.continuous, {}}; }

Interval negated_if(Truth turned, const Interval& a) {
  return {select(turned, a.hi, a.nlo), select(turned, a.nlo, a.hi), a.empty, a.continuous, {}};
}

// The solutions x >= 0. The signs of both are turned so that n holds 0 or is positive. A positive n needs a positive d,
// and the solutions are n.lo / d.hi and more; they end where d ends above 0. min answers its second operand on NaN.
Interval solutions_above(const Interval& numerator, const Interval& divisor) {
  const Truth turned = lies_below(numerator) || (!lies_above(numerator) && lies_below(divisor));
  const Interval n = negated_if(turned, numerator), d = negated_if(turned, divisor);
  const Expr none = zero(n.hi), all = constant_like(n.hi, infinity);
  const Truth positive = lies_above(n);
  const Expr nlo = select(positive, min(div_up(n.nlo, d.hi), none), none);
  const Expr hi = select(lies_above(d), min(div_up(n.hi, d.lo()), all), all);
  const Truth impossible = positive && d.hi <= 0;
  return {nlo, hi, n.empty || d.empty || impossible, n.continuous && d.continuous, {.nonnegative = true}};
}

}  // namespace

HalfLines half_lines(const Interval& numerator, const Interval& divisor) {
  return {negated(solutions_above(negated(numerator), divisor)), solutions_above(numerator, divisor)};
}

}  // namespace imp
