// Interval bisection without a stack (Knoll et al. 2009, §5.5, Algorithm 4), lanes independent.
//
// A piece [s, s + h] that may hold a zero is halved; one that does not is left behind, and after a
// right half the next piece is twice as long: the index k of the piece on its level takes the place
// of a stack (Knoll's modulus test, one level a step). A piece as short as epsilon (eq. 16 with the
// segment as unit) is not halved. Such pieces form a *run*, and the search goes on until the run
// ends: the excluded pieces before and behind it have proven signs, so a change of sign is proven
// without a single evaluation at a point.
//
//    excluded, f > 0     run    excluded, f < 0
//   ├────────┼────┼──┼─┼?┼?┼?┼──┼─────────┤
//
// That is a hit if f is continuous on the run, and the run is short or df/ds excludes 0 on it.
// Certain to be right; undecided where f touches zero, or where the inclusion is too wide to
// exclude the pieces beside the root. About log2(1/epsilon) inclusions times the overestimation.
#include <algorithm>

#include "ir/loop.h"
#include "runtime/search/parts/proven.h"
#include "runtime/search/parts/run.h"
#include "runtime/search/search.h"

namespace imp {
namespace {

Truth is_even(Expr whole) {
  const Expr half = 0.5 * whole;
  return equal(floor(half), half);
}

}  // namespace

std::optional<Found> stackless(Program& program, const RayFunction& f, const SearchLimits& limits,
                               Diagnostics& /*diagnostics*/) {
  const Expr zero_ = zero(f.like), one_ = one(f.like);
  const Truth no = truth_of(program.graph, false), yes = truth_of(program.graph, true);
  const double epsilon = epsilon_of(limits, f.like.type());

  Loop loop(program, "bisect", limits.steps);
  const Expr s = loop.state("s", zero_);
  const Expr h = loop.state("h", one_);
  const Expr k = loop.state("k", zero_);            // s = k h
  const Truth open = loop.state("open", no);        // in a run
  const Expr run = loop.state("run", zero_);        // where it began
  const Expr before = loop.state("before", zero_);  // the sign of f before it; 0: not known
  const Expr after = loop.state("after", zero_);    // and behind it
  const Truth smooth = loop.state("smooth", yes);   // f is continuous on it
  const Expr steps = loop.state("steps", zero_);

  const Expr end = s + h;
  const Interval bound = f.bound(interval(-s, end, {.nonnegative = true, .bounded = true}));
  const Truth root = may_be_zero(bound);
  const Truth split = root && h > epsilon;
  const Truth unsplit = root && !(h > epsilon);
  const Truth closed = open && !root;
  const Expr sign = proven_sign(bound);
  const Truth in_run = unsplit || closed;

  const Expr right = k + 1.0;
  const Truth widen = is_even(right) && !in_run;
  const Expr next_s = select(split || closed, s, end);
  const Expr run_start = select(open, run, s);

  loop.next(s, next_s);
  loop.next(h, select(split, 0.5 * h, select(widen, 2.0 * h, h)));
  loop.next(k, select(split, 2.0 * k, select(widen, 0.5 * right, select(closed, k, right))));
  loop.next(open, open || unsplit);
  loop.next(run, select(unsplit, run_start, run));
  loop.next(before, select(root || open, before, sign));
  loop.next(after, select(closed, sign, after));
  loop.next(smooth, smooth && (!unsplit || bound.continuous));
  loop.next(steps, steps + 1.0);
  loop.enter_if(f.exists);
  loop.again_while(!closed && next_s < 1 && !(unsplit && end - run_start > longest_run(epsilon)));

  const Truth found = loop.result(open);
  const Expr a = loop.result(run), b = loop.result(s);
  return answer(f,
                {.found = found,
                 .a = a,
                 .b = b,
                 .before = loop.result(before),
                 .after = loop.result(after),
                 .smooth = loop.result(smooth),
                 .single = monotone(f, a, b)},
                !found && b >= 1, loop.result(steps));
}

}  // namespace imp
