// Isolation by the derivative: where df/ds excludes 0 there is at most one root, and signs at both ends decide.
//
// A piece [s, s + h] that may hold a zero is halved until df/ds excludes 0 on it (bisection without a stack, as in
// stackless.cpp). Such *monotone* pieces are not split further: neighbours of one direction form a *run*, until an
// excluded piece behind it tells the sign there. Where no excluded piece lies beside the run (the end of the ray,
// a piece that is not monotone) the enclosure of f at the point itself tells the sign: the *probe*.
//
//    excluded, f > 0       monotone run        excluded, f < 0
//   ├───────────────┼───────────┼───────────┼─────────────────┤
//
// A change of sign across a monotone run is one root, a certified hit; equal signs are none, and the search goes on
// behind. Pieces of length epsilon that are neither excluded nor monotone form a run as well, as in stackless: a hit
// if the sign changes across a short one. Right wherever the inclusions are; undecided where f touches zero. A few
// inclusions of f and df/ds for each critical point on the way, where bisection takes about twenty for each root
// (interval Newton isolates so: Moore 1966, Caprani and others 1993; speed: no halving once f is monotone).
#include "ir/loop.h"
#include "runtime/search/parts/proven.h"
#include "runtime/search/parts/run.h"
#include "runtime/search/search.h"

namespace imp {

std::optional<Found> isolate(Program& program, const RayFunction& f, const SearchLimits& limits,
                             Diagnostics& /*diagnostics*/) {
  const Expr zero_ = zero(f.like), one_ = one(f.like);
  const Truth no = truth_of(program.graph, false);
  const double epsilon = epsilon_of(limits, f.like.type());

  Loop loop(program, "isolate", limits.steps);
  const Expr s = loop.state("s", zero_);
  const Expr h = loop.state("h", one_);
  const Expr k = loop.state("k", zero_);            // s = k h
  const Truth probing = loop.state("probing", no);  // this step is about the point s alone
  const Truth probed = loop.state("probed", no);    // and has been
  const RunStates states = run_states(program, loop, f.like);
  const auto [open, run, slope, before, after, smooth] = states;
  const Expr steps = loop.state("steps", zero_);

  const Expr end = s + h;
  const Interval piece = interval(-s, select(probing, s, end), {.nonnegative = true, .bounded = true});
  const Interval bound = f.bound(piece), slopes = f.slope_bound(piece);
  const Expr sign = proven_sign(bound);
  const Expr direction = select(slopes.continuous && bound.continuous, proven_sign(slopes), zero_);
  const Truth excluded = !may_be_zero(bound);
  const Truth monotone = abs(direction) > 0;

  // A probe. With a sign it closes a run; without one the run goes on.
  const Truth told = probing && abs(sign) > 0;
  // A piece.
  const Truth searching = !probing;
  const Truth unknown_start = !open && !(abs(before) > 0) && !probed;
  const Truth fits = monotone && (!open || equal(direction, slope));
  const Truth joins_smoothly = searching && !excluded && fits && !unknown_start;
  const Truth broken = searching && !excluded && !fits;
  const Truth asks = (searching && !excluded && fits && unknown_start) ||  // the sign before a run
                     (broken && open && abs(slope) > 0 && !probed);        // and behind it
  const Truth split = broken && !asks && h > epsilon;
  const Truth doubtful = broken && !asks && !split;
  const Truth joins = joins_smoothly || doubtful;
  const Truth passes = searching && excluded;

  // What ends a run, and what that tells.
  const Truth closed = open && (told || passes);
  const Truth same = before * sign > 0;
  const Truth dropped = closed && abs(slope) > 0 && same;  // monotone, of equal signs: no root in it
  const Truth ends_search = closed && !dropped;

  const Truth moves = passes || joins;
  const Expr right = k + 1.0;
  const Expr half = 0.5 * right;
  const Truth widen = passes && equal(floor(half), half);
  const Expr next_s = select(moves && !ends_search, end, s);
  const Truth at_end = !(next_s < 1);
  const Truth next_open = (open && !dropped) || joins;
  const Expr run_start = select(open, run, s);
  const Truth probes_end = joins && at_end;

  loop.next(s, next_s);
  loop.next(h, select(split, 0.5 * h, select(widen, 2.0 * h, h)));
  loop.next(k, select(split, 2.0 * k, select(widen, half, select(moves, right, k))));
  loop.next(probing, asks || probes_end);
  loop.next(probed, (probing || (probed && !moves)));
  loop.next(open, next_open);
  loop.next(run, select(joins, run_start, run));
  loop.next(slope, select(joins, select(doubtful, zero_, direction), slope));
  loop.next(before, select((passes || told) && (!open || dropped), sign, before));
  loop.next(after, select(ends_search, sign, after));
  loop.next(smooth, smooth && (!joins || bound.continuous));
  loop.next(steps, steps + 1.0);
  loop.enter_if(f.exists);
  const Truth too_long = doubtful && end - run_start > longest_run(epsilon);
  loop.again_while(!ends_search && !too_long && (!at_end || probes_end));

  const Run last = run_after(loop, states, s);
  return answer(f, last, !last.found && last.b >= 1, loop.result(steps));
}

}  // namespace imp
