#include "runtime/search/parts/refine.h"

#include <limits>

#include "ir/loop.h"
#include "runtime/search/parts/proven.h"

namespace imp {
namespace {

// How far from s its neighbours with proven signs may lie.
// About half of what is promised, as normals are taken at s.
constexpr double reach = 0.45 * certified_length;

// One step of Newton's method with bisection, from s in [lo, hi].
struct Step {
  Expr lo, hi;      // the bracket without what lies on the wrong side of s
  Expr next;        // where to go
  Truth by_newton;  // and how
};

// `right`: the root lies right of s. `last` is the length of the step before: a step of Newton's method that is
// not half as long does not converge.
Step step_from(Expr s, Expr lo, Expr hi, Expr last, Truth right, Expr newton) {
  const Expr next_lo = select(right, s, lo), next_hi = select(right, hi, s);
  const Truth good = next_lo < newton && newton < next_hi && 2.0 * abs(newton - s) < last;
  return {next_lo, next_hi, select(good, newton, 0.5 * (next_lo + next_hi)), good};
}

struct Approach {
  Expr s, slope;  // df/ds about there
};

// In the arithmetic of the kernel. In floats it ends where Newton's method seems to converge; one step in double
// follows. Where that is wrong the enclosures find out.
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

// One step in double. It undoes what rounding f in floats moved the root by, upward above all, as errors add up.
// The slope stays that of floats: near the root it is good enough.
Expr corrected(const RayFunction& f, const Bracket& bracket, const Approach& start) {
  const Expr s = to(f32, to(f64, start.s) - f.value_in_double(start.s) / to(f64, start.slope));
  return select(bracket.a <= s && s <= bracket.b, s, start.s);
}

// By proven signs only. The bracket [lo, hi] has them at its ends. It shrinks until some s has both within `reach`.
// The first two looks are at the neighbours of the proposed place. Places without a proven sign form a gap in
// the middle. The larger side beside it is halved, until the gap is too wide to confirm any place.
//
//    lo  sign_a             gap_lo   gap_hi            -sign_a  hi
//   ├──────────────────────────┼────────┼──────────────────────────┤
Refined enclose_root(Program& program, const RayFunction& f, const Bracket& bracket, Expr proposed) {
  const auto& [a, b, sign_a, changes] = bracket;
  const Expr none = constant_like(a, 2);  // behind every place

  Loop loop(program, "confirm", 96);
  const Expr lo = loop.state("lo", a);
  const Expr hi = loop.state("hi", b);
  const Expr gap_lo = loop.state("gap_lo", none);
  const Expr gap_hi = loop.state("gap_hi", -none);
  const Expr looks = loop.state("looks", zero(a));
  // About f at both ends, for a secant in between; NaN: not known.
  const Expr unknown_value = to(f64, constant_like(a, std::numeric_limits<double>::quiet_NaN()));
  const Expr at_lo = loop.state("at_lo", unknown_value), at_hi = loop.state("at_hi", unknown_value);

  const Truth gap = gap_lo <= gap_hi;
  const Truth left_is_larger = gap_lo - lo > hi - gap_hi;
  const Expr middle =
      select(gap, select(left_is_larger, 0.5 * (lo + gap_lo), 0.5 * (gap_hi + hi)), 0.5 * (lo + hi));
  const Expr wanted = select(looks < 0.5, proposed - reach, select(looks < 1.5, proposed + reach, middle));
  const Expr place = select(lo < wanted && wanted < hi, wanted, middle);
  const Interval bound = f.bound_in_double(place);
  const Expr sign = proven_sign(bound), value = 0.5 * (bound.hi - bound.nlo);
  const Truth left = sign * to(f64, sign_a) > 0, right = sign * to(f64, sign_a) < 0;
  const Truth unknown = !left && !right;

  // A proven sign on the far side of the gap tells of another root, beside which the gap does not matter.
  const Expr next_lo = select(left, place, lo), next_hi = select(right, place, hi);
  const Truth kept = gap && next_lo <= gap_lo && gap_hi <= next_hi;
  const Expr next_gap_lo = select(unknown, min(gap_lo, place), select(kept, gap_lo, none));
  const Expr next_gap_hi = select(unknown, max(gap_hi, place), select(kept, gap_hi, -none));
  loop.next(lo, next_lo);
  loop.next(hi, next_hi);
  loop.next(gap_lo, next_gap_lo);
  loop.next(gap_hi, next_gap_hi);
  loop.next(looks, looks + 1.0);
  loop.next(at_lo, select(left, value, at_lo));
  loop.next(at_hi, select(right, value, at_hi));
  const auto close = [](Expr left_end, Expr right_end) { return right_end - left_end <= 2 * reach; };
  loop.enter_if(changes && !close(a, b));
  loop.again_while(!close(next_lo, next_hi) && !(next_gap_hi - next_gap_lo > 2 * reach));

  const Expr first = loop.result(lo), last = loop.result(hi);
  const Expr share = to(a.type(), loop.result(at_lo) / (loop.result(at_lo) - loop.result(at_hi)));
  const Expr better = select(0 <= share && share <= 1, first + share * (last - first), proposed);
  const Expr s = min(max(better, max(first, last - reach)), min(last, first + reach));
  const Truth enclosed = changes && close(first, last);
  return {select(enclosed, s, 0.5 * (first + last)), first, last, enclosed};
}

}  // namespace

Refined refine(Program& program, const RayFunction& f, const Bracket& bracket) {
  const Approach start = approach(program, f, bracket);
  const Expr s = f.like.type() == f64 ? start.s : corrected(f, bracket, start);
  return enclose_root(program, f, bracket,
                      select(bracket.a <= s && s <= bracket.b, s, 0.5 * (bracket.a + bracket.b)));
}

Expr verdict_with(const Refined& root, Expr verdict) {
  const Truth hit = equal(verdict, constant_like(verdict, verdict_hit));
  return select(hit && !root.enclosed, constant_like(verdict, verdict_undecided), verdict);
}

}  // namespace imp
