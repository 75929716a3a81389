#include "runtime/search/parts/refine.h"

#include "ir/loop.h"

namespace imp {
namespace {

constexpr double close = 0.5 * certified_length;  // the root is to be enclosed in a piece as short

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

struct Approach {
  Expr s, slope;  // df/ds about there
};

// In the arithmetic of the kernel. In floats it is left where Newton's method seems to converge, to one step in double:
// what is wrong about that the probe finds out.
Approach approach(Program& program, const RayFunction& f, const Bracket& bracket) {
  const bool in_float = f.like.type() == f32;
  const auto& [a, b, sign_a, changes] = bracket;

  Loop loop(program, "refine", in_float ? 24 : 64);
  const Expr lo = loop.state("lo", a);
  const Expr hi = loop.state("hi", b);
  const Expr s = loop.state("s", 0.5 * (a + b));
  const Expr last = loop.state("last", b - a);
  const Expr slope = loop.state("slope", zero(a));

  const Expr value = f.value(s), slope_here = f.slope(s);
  const Step step = step_from(s, lo, hi, last, value * sign_a > 0, s - value / slope_here);
  const Expr length = abs(step.next - s);
  loop.next(lo, step.lo);
  loop.next(hi, step.hi);
  loop.next(s, step.next);
  loop.next(last, length);
  loop.next(slope, slope_here);
  loop.enter_if(changes);
  const double resolution = in_float ? 0x1p-25 : 0x1p-54;
  const Truth unfinished = length > resolution * abs(s) && step.hi - step.lo > resolution;
  const Truth converges = step.by_newton && length < 0x1p-8;
  loop.again_while(in_float ? unfinished && !converges : unfinished);
  return {loop.result(s), loop.result(slope)};
}

// One step in double: what the rounding of f in floats moved the root by is gone, upward rounding above all, whose
// errors add up. The slope is as good as another one.
Expr corrected(const RayFunction& f, const Bracket& bracket, const Approach& start) {
  const Expr s = to(f32, to(f64, start.s) - f.value_in_double(start.s) / to(f64, start.slope));
  return select(bracket.a <= s && s <= bracket.b, s, start.s);
}

// Looks at both sides of s.
Refined probe(const RayFunction& f, const Bracket& bracket, Expr s) {
  const Expr lo = max(s - 0.5 * close, bracket.a), hi = min(s + 0.5 * close, bracket.b);
  const Expr at_lo = f.value_in_double(lo), at_hi = f.value_in_double(hi);
  const Expr sign_a = to(f64, bracket.sign_a);
  const Expr secant = to(f32, at_lo / (at_lo - at_hi));
  const Expr share =
      select(0 <= secant && secant <= 1, secant, constant_like(secant, 0.5));  // f may be infinite
  return {lo + share * (hi - lo), bracket.changes && at_lo * sign_a > 0 && at_hi * sign_a < 0};
}

// Where the probe fails, the same bracket again with f in double. A step that seems to arrive is followed by a look at
// the other side of the root, and from there further and further. The slope stays as it is: near the root it is as good
// as another one, and half of what a step would take.
Refined polish(Program& program, const RayFunction& f, const Bracket& bracket, const Approach& start,
               Truth wanted) {
  const auto& [a, b, sign_a, changes] = bracket;

  Loop loop(program, "polish", 64);
  const Expr lo = loop.state("lo", a);
  const Expr hi = loop.state("hi", b);
  const Expr s = loop.state("s", start.s);
  const Expr last = loop.state("last", b - a);
  const Expr reach = loop.state("reach", constant_like(a, 0.5 * close));
  const Expr best = loop.state("best", start.s);
  const Truth found = loop.state("found", truth_of(program.graph, false));

  const Expr value = f.value_in_double(s);
  const Truth right = value * to(f64, sign_a) > 0;
  const Expr newton = to(f32, to(f64, s) - value / to(f64, start.slope));
  const Step step = step_from(s, lo, hi, last, right, newton);
  const Expr length = abs(step.next - s);
  const Truth enclosed = step.hi - step.lo <= close;
  const Truth arrives = step.by_newton && length < 0.25 * close && !enclosed;
  const Expr other_side = step.next + select(right, reach, -reach);
  const Truth inside = step.lo < other_side && other_side < step.hi;
  loop.next(lo, step.lo);
  loop.next(hi, step.hi);
  loop.next(s, select(arrives, select(inside, other_side, 0.5 * (step.lo + step.hi)), step.next));
  loop.next(last, select(arrives, step.hi - step.lo, length));
  loop.next(reach, select(arrives, 8.0 * reach, reach));
  loop.next(best, step.next);
  loop.next(found, enclosed && equal(value, value));
  loop.enter_if(wanted);
  loop.again_while(equal(value, value) && !enclosed);
  return {loop.result(best), loop.result(found)};
}

}  // namespace

Refined refine(Program& program, const RayFunction& f, const Bracket& bracket) {
  const Approach start = approach(program, f, bracket);
  if (f.like.type() == f64) return {start.s, bracket.changes};
  const Expr s = corrected(f, bracket, start);
  const Refined seen = probe(f, bracket, s);
  const Refined polished = polish(program, f, bracket, {s, start.slope}, bracket.changes && !seen.enclosed);
  return {select(seen.enclosed, seen.s, polished.s), seen.enclosed || polished.enclosed};
}

Expr verdict_with(const Refined& root, Expr verdict) {
  const Truth hit = equal(verdict, constant_like(verdict, verdict_hit));
  return select(hit && !root.enclosed, constant_like(verdict, verdict_undecided), verdict);
}

}  // namespace imp
