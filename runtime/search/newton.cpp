// Interval Newton, with division through zero (Caprani, Hvidegaard, Mortensen and Schneider 2000; Moore 1966; Hansen and
// Walster 2004).
//
// A piece X that F does not exclude is looked at from its middle c. By the mean value theorem every root x in X has
// f(c) = d (c - x) for a d in F'(X), so roots can only lie on two half-lines, and not between them:
//
//         may hold roots       f has the sign of f(c)      may hold roots
//   s ├───────────────────┤              c            ├─────────────────────┤ e
//
// The left one is next, the right one is kept (parts/pieces.h); where f(c) may be 0 they meet at c. Both are a little
// longer than proven, so that their new ends lie in the gap: the sign of f at the start of every piece is proven then,
// but for the first one. On a piece where F' excludes 0 there is one root at most,
//
//    and it is there    if f(c) has another sign than f at the start, or all solutions lie in the inside of X;
//    and it is not      if f goes away from 0 at the start.
//
// Pieces on which neither is known, and which are as short as epsilon or monotone with f(c) about 0, form a run, as in
// isolate.cpp. The next proven sign closes it; while a run is open gaps are looked at like pieces. The mean value
// theorem asks for f and f' continuous on X; elsewhere pieces are halved. Undecided where f touches zero.
#include "ir/loop.h"
#include "passes/extend/half_lines.h"
#include "runtime/search/parts/pieces.h"
#include "runtime/search/parts/proven.h"
#include "runtime/search/parts/run.h"
#include "runtime/search/search.h"

namespace imp {
namespace {

// More are seldom left, and a shader copies the table a step.
constexpr std::uint32_t kept_pieces = 8;

// What a step of Newton's method from c leaves of a piece [s, e].
struct Rest {
  Truth left, right;           // there may be roots in [s, left_end], and in [right_start, e]
  Expr left_end, right_start;  // f is not 0 there, and between, but where they are c
  Truth starts_in, ends_in;    // all solutions, in X or not, lie right of s; left of e
};
// If f rises and all solutions lie right of s, f(s) < 0: from f(s) >= 0 and f(c) = f(s) + d (c - s) it would follow that
// c - f(c)/d <= s, a solution. So for falling f, and for e.

// A place between c and `place`, near that; f is not 0 between, nor there.
Expr in_gap(Expr place, Expr c) {
  const Expr near = place + (c - place) * 0x1p-6;
  const Truth between = (place < near && near < c) || (c < near && near < place);
  return select(between, near, c);
}

// f(c) = d (c - x): the solutions c - x >= 0 lie left of c.
Rest newton_step(Expr s, Expr e, Expr c, const Interval& at_c, const Interval& slopes, Truth regular) {
  const auto [below, above] = half_lines(at_c, slopes);
  const Expr last_left = min(add_up(c, above.nlo), c), first_right = max(-add_up(below.hi, -c), c);
  return {!regular || (!above.empty && last_left >= s), !regular || (!below.empty && first_right <= e),
          select(regular, in_gap(last_left, c), c),     select(regular, in_gap(first_right, c), c),
          above.empty || add_up(above.hi, -c) < -s,     below.empty || add_up(c, below.nlo) < e};
}

}  // namespace

std::optional<Found> newton(Program& program, const RayFunction& f, const SearchLimits& limits,
                            Diagnostics& /*diagnostics*/) {
  const Expr zero_ = zero(f.like), one_ = one(f.like);
  const double epsilon = epsilon_of(limits, f.like.type());

  Loop loop(program, "newton", limits.steps);
  const Expr s = loop.state("s", zero_);  // the piece is [s, e]
  const Expr e = loop.state("e", one_);
  Pieces pieces(program, loop, f.like, kept_pieces);
  const RunStates states = run_states(program, loop, f.like);
  const auto [open, run, slope, before, after, smooth] = states;
  const Expr steps = loop.state("steps", zero_);

  const Interval piece = interval(-s, e, {.nonnegative = true, .bounded = true});
  const Expr c = 0.5 * (s + e);
  const Interval bound = f.bound(piece), slopes = f.slope_bound(piece), at_c = f.bound_at(c);
  const Truth regular = bound.continuous && slopes.continuous && is_ordered(at_c) && is_ordered(slopes);
  const Expr sign_c = proven_sign(at_c);
  const Expr direction = select(regular, proven_sign(slopes), zero_);
  const Truth monotone = abs(direction) > 0;
  const Rest rest = newton_step(s, e, c, at_c, slopes, regular);

  // No root in the piece, and the sign of f on all of it.
  const Truth out_of_reach = !may_be_zero(bound);
  const Truth goes_away = !open && before * direction > 0;
  const Truth excluded = out_of_reach || goes_away || (!rest.left && !rest.right);
  const Expr sign = select(out_of_reach, proven_sign(bound), select(goes_away, before, sign_c));
  // The sign at s; 0: not known.
  const Expr sign_s = select(
      excluded, sign, select(!rest.left, sign_c, select(monotone && rest.starts_in, -direction, zero_)));

  // What ends a run, and what that tells.
  const Truth fits = monotone && (!open || equal(direction, slope));
  const Truth crosses = !excluded && fits && before * sign_c < 0;
  const Truth closed = open && !crosses && (excluded || abs(sign_s) > 0);
  const Truth dropped = closed && abs(slope) > 0 && before * sign_s > 0;  // of equal signs: no root in it
  const Truth closes = closed && !dropped;
  const Truth in_run = open && !dropped;
  const Truth surrounds = !excluded && monotone && rest.starts_in && rest.ends_in && !in_run && !crosses;
  const Truth ends_search = crosses || closes || surrounds;

  // A monotone piece of which the middle tells nothing waits for the next sign: halves would tell no more.
  const Truth known_start = abs(before) > 0 || abs(sign_s) > 0;
  const Truth waits = fits && known_start && equal(sign_c, zero_);
  const Truth split = !excluded && !waits && e - s > epsilon;
  const Truth joins = !excluded && !split && !ends_search;
  const Truth moves = excluded || joins;
  const Truth next_open = in_run || joins;
  const Expr run_start = select(in_run, run, s);
  // What lies behind the piece: a gap, to be passed if no run is open; the next piece; or the end of the segment.
  const Truth enters_gap = moves && next_open && e < pieces.start();
  const Truth pops = moves && !enters_gap;
  const Truth at_end = pops && !pieces.any() && (!next_open || s >= 1);

  const Expr moved_s = select(enters_gap, e, pieces.start());
  const Expr moved_e = select(enters_gap, pieces.start(), pieces.end());
  const Expr split_s = select(rest.left, s, rest.right_start);
  const Expr split_e = select(rest.left, rest.left_end, e);
  const Expr found_a = select(crosses, run_start, select(rest.left, s, c));
  const Expr found_b = select(crosses || !rest.right, c, e);
  const Expr direction_of_run = select(fits || !in_run, direction, zero_);
  const Truth found_here = crosses || surrounds;
  const Expr next_s = select(moves, moved_s, select(split, split_s, s));

  loop.next(s, select(found_here, found_b, select(closes, s, next_s)));
  loop.next(e, select(moves, moved_e, select(split, split_e, e)));
  pieces.next(split && rest.left && rest.right, pops && pieces.any(), rest.right_start, e);
  loop.next(open, next_open || found_here);
  loop.next(run, select(found_here, found_a, select(joins, run_start, run)));
  loop.next(slope, select(found_here || joins, direction_of_run, slope));
  loop.next(before,
            select(surrounds, -direction, select(!in_run && (excluded || abs(sign_s) > 0), sign_s, before)));
  loop.next(after, select(crosses, sign_c, select(surrounds, direction, select(closes, sign_s, after))));
  loop.next(smooth, smooth && (!joins || bound.continuous));
  loop.next(steps, steps + 1.0);
  loop.enter_if(f.exists);
  const Truth too_long = joins && equal(direction_of_run, zero_) && e - run_start > longest_run(epsilon);
  loop.again_while(!ends_search && !too_long && !at_end);

  const Run last = run_after(loop, states, s);
  return answer(f, last, !last.found && last.b >= 1, loop.result(steps));
}

}  // namespace imp
