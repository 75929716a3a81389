#include "runtime/search/parts/refine.h"

#include "ir/loop.h"

namespace imp {
namespace {

// One step of Newton's method with bisection, from s in [lo, hi].
struct Step {
  Expr lo, hi;      // the bracket without what lies on the wrong side of s
  Expr next;        // where to go
  Truth by_newton;  // and how
};

// `right`: the root lies right of s. `last` is the length of the step before: a step of Newton's method that is not
// half as long does not converge.
Step step_from(Expr s, Expr lo, Expr hi, Expr last, Truth right, Expr newton) {
  const Expr next_lo = select(right, s, lo), next_hi = select(right, hi, s);
  const Truth good = next_lo < newton && newton < next_hi && 2.0 * abs(newton - s) < last;
  return {next_lo, next_hi, select(good, newton, 0.5 * (next_lo + next_hi)), good};
}

// In the arithmetic of the kernel. In floats it is left where Newton's method seems to converge: what is wrong
// about that the polish finds out.
Expr approach(Program& program, const RayFunction& f, const Bracket& bracket) {
  const bool in_float = f.like.type() == f32;
  const auto& [a, b, sign_a, changes] = bracket;

  Loop loop(program, "refine", in_float ? 24 : 64);
  const Expr lo = loop.state("lo", a);
  const Expr hi = loop.state("hi", b);
  const Expr s = loop.state("s", 0.5 * (a + b));
  const Expr last = loop.state("last", b - a);
  const Truth newton_before = loop.state("newton", truth_of(program.graph, false));

  const Expr value = f.value(s);
  const Step step = step_from(s, lo, hi, last, value * sign_a > 0, s - value / f.slope(s));
  const Expr length = abs(step.next - s);
  loop.next(lo, step.lo);
  loop.next(hi, step.hi);
  loop.next(s, step.next);
  loop.next(last, length);
  loop.next(newton_before, step.by_newton);
  loop.enter_if(changes);
  const double resolution = in_float ? 0x1p-25 : 0x1p-54;
  const Truth unfinished = length > resolution * abs(s) && step.hi - step.lo > resolution;
  const Truth converges = step.by_newton && newton_before && length < 0x1p-4 * last && length < 0x1p-12;
  loop.again_while(in_float ? unfinished && !converges : unfinished);
  return loop.result(s);
}

// With f in double, from the same bracket, until signs prove to double's satisfaction that the root is as near as is
// promised: a step that seems to arrive is followed by a look at the other side of the root.
Expr polish(Program& program, const RayFunction& f, const Bracket& bracket, Expr start) {
  constexpr double near = 0.5 * certified_length;
  const auto& [a, b, sign_a, changes] = bracket;

  Loop loop(program, "polish", 64);
  const Expr lo = loop.state("lo", a);
  const Expr hi = loop.state("hi", b);
  const Expr s = loop.state("s", start);
  const Expr last = loop.state("last", b - a);
  const Expr best = loop.state("best", start);

  const Expr value = f.value_in_double(s);
  const Truth right = value * to(f64, sign_a) > 0;
  const Expr newton = to(f32, to(f64, s) - value / f.slope_in_double(s));
  const Step step = step_from(s, lo, hi, last, right, newton);
  const Expr length = abs(step.next - s);
  const Truth enclosed = step.hi - step.lo <= near;
  const Truth arrives = step.by_newton && length < 0.25 * near && !enclosed;
  const Expr other_side =
      step.next + select(right, constant_like(s, 0.5 * near), constant_like(s, -0.5 * near));
  loop.next(lo, step.lo);
  loop.next(hi, step.hi);
  loop.next(s, select(arrives, min(max(other_side, step.lo), step.hi), step.next));
  loop.next(last, select(arrives, step.hi - step.lo, length));
  loop.next(best, step.next);
  loop.enter_if(changes);
  loop.again_while(equal(value, value) && !enclosed);
  return loop.result(best);
}

}  // namespace

Expr refine(Program& program, const RayFunction& f, const Bracket& bracket) {
  const Expr s = approach(program, f, bracket);
  return f.like.type() == f32 ? polish(program, f, bracket, s) : s;
}

}  // namespace imp
