// Segment tracing (Galin, Guérin, Paris and Peytavie 2020): steps by the slopes of the piece ahead.
//
// Sphere tracing needs a bound of the gradient for all of space, which the user must know. Here a step asks how fast f
// falls or rises on the piece [s, e] ahead, by an enclosure of df/ds over it. A positive f comes down to 0 not before
// s + f(s)/fall, and going back from e not before e - f(e)/rise:
//
//    f(s) \       / f(e)
//          \     /            excluded where these places do not meet
//    ───────\───/─────────
//
// Where f changes its sign between s and e and df/ds excludes 0 there is one root, and so the first. Else the
// next piece is twice as long as f(s)/fall, the part that is excluded, and at most half as long as this one; after an excluded
// piece the next is twice as long (the paper's κ).
//
// Right for f of which the slopes are known better than the values: steep or wavy, with few roots. f needs a
// derivative; where it jumps, has a kink or is not defined, the inclusion of f over the piece decides, as in other
// searches. Undecided where f touches zero. Two enclosures a step, and some ten steps a ray.
#include "ir/loop.h"
#include "runtime/search/parts/proven.h"
#include "runtime/search/parts/run.h"

namespace imp {
namespace {

// The least |f| in the interval, from below; 0 where none is proven.
Expr least_magnitude(const Interval& f, Expr sign) {
  return select(sign > 0, f.lo(), select(sign < 0, -f.hi, zero(sign)));
}

}  // namespace

std::optional<Found> segment_tracing(Program& program, const RayFunction& f, const SearchLimits& limits,
                                     Diagnostics& /*diagnostics*/) {
  const Expr zero_ = zero(f.like), one_ = one(f.like);
  const Truth no = truth_of(program.graph, false), yes = truth_of(program.graph, true);
  const double epsilon = epsilon_of(limits, f.like.type());
  const Interval at_zero = f.bound_at(zero_);

  Loop loop(program, "trace", limits.steps);
  const Expr s = loop.state("s", zero_);
  const Expr h = loop.state("h", one_);
  const Expr sign = loop.state("sign", proven_sign(at_zero));  // of f at s; 0: not known
  const Expr height =
      loop.state("height", least_magnitude(at_zero, proven_sign(at_zero)));  // |f| there at least
  const Truth open = loop.state("open", no);                                 // in a run
  const Expr run = loop.state("run", zero_);                                 // where it began
  const Expr before = loop.state("before", zero_);                           // the sign of f there
  const Expr after = loop.state("after", zero_);                             // and where it ended
  const Truth smooth = loop.state("smooth", yes);                            // f is continuous on it
  const Expr steps = loop.state("steps", zero_);

  const Expr end = min(s + h, one_);
  const Interval piece = interval(-s, end, {.nonnegative = true, .bounded = true});
  const Interval bound = f.bound(piece), slope = f.slope_bound(piece), at_end = f.bound_at(end);
  const Expr sign_end = proven_sign(at_end), height_end = least_magnitude(at_end, sign_end);
  const Expr length = add_up(end, -s);

  // How fast |f| falls from s on, and from the end backwards, at most.
  const Expr fall = select(sign > 0, slope.nlo, slope.hi), rise = select(sign > 0, slope.hi, slope.nlo);
  const Expr meeting = mul_up(mul_up(length, fall), rise);
  const Expr apart = fma_up(-height, rise, mul_up(-height_end, fall));  // negated, and so rounded down
  const Truth regular = bound.continuous && slope.continuous;
  const Truth same = sign * sign_end > 0, opposite = sign * sign_end < 0;
  const Truth never_meet = fall > 0 && rise > 0 && meeting < -apart;
  const Truth nowhere_zero = is_ordered(slope) && same && (fall <= 0 || rise <= 0 || never_meet);
  Truth excluded = bound.empty || (regular && nowhere_zero);
  // A polynomial is regular everywhere, and its inclusion over the piece need not be computed.
  if (program.graph.truth_value(regular.id) != true) excluded = excluded || !may_be_zero(bound);

  const Truth one_root = opposite && regular && !may_be_zero(slope);
  const Truth doubtful = !excluded && !one_root;
  const Truth split = doubtful && length > epsilon;
  const Truth in_run = one_root || (doubtful && !split);
  const Expr run_start = select(open, run, s);
  const Truth run_ends = in_run && (!equal(sign_end, zero_) || end - run_start > longest_run(epsilon));
  const Expr free_part = 2.0 * height / fall;
  const Expr shorter = select(free_part > 0 && free_part < 0.5 * length, free_part, 0.5 * length);

  loop.next(s, select(split, s, end));
  loop.next(h, select(split, max(shorter, constant_like(h, epsilon)), select(excluded, 2.0 * h, h)));
  loop.next(sign, select(split, sign, sign_end));
  loop.next(height, select(split, height, height_end));
  loop.next(open, open || in_run);
  loop.next(run, select(in_run, run_start, run));
  loop.next(before, select(in_run && !open, sign, before));
  loop.next(after, select(in_run, sign_end, after));
  loop.next(smooth, smooth && (!in_run || bound.continuous));
  loop.next(steps, steps + 1.0);
  loop.enter_if(f.exists);
  loop.again_while((split || end < 1) && !run_ends);

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
