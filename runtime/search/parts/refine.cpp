#include "runtime/search/parts/refine.h"

#include "ir/loop.h"

namespace imp {
namespace {

// Where a step of Newton's method is far shorter than the one before, which was one too, it is about the square root
// of what it leaves.
constexpr double enough_before_polish = 0x1p-12, enough_of_polish = 0x1p-20;
constexpr double far_shorter = 0x1p-4;

}  // namespace

Expr refine(Program& program, const RayFunction& f, const Bracket& bracket) {
  const bool in_float = f.like.type() == f32;
  const auto [a, b, sign_a, changes] = bracket;

  Loop loop(program, "refine", in_float ? 24 : 64);
  const Expr lo = loop.state("lo", a);
  const Expr hi = loop.state("hi", b);
  const Expr s = loop.state("s", 0.5 * (a + b));
  const Expr last = loop.state("last", b - a);  // the length of the last step
  const Truth by_newton = loop.state("newton", truth_of(program.graph, false));  // which was one of Newton's

  const Expr value = f.value(s);
  const Truth right = value * sign_a > 0;  // the root lies right of s
  const Expr next_lo = select(right, s, lo);
  const Expr next_hi = select(right, hi, s);

  const Expr newton = s - value / f.slope(s);
  const Truth good = next_lo < newton && newton < next_hi && 2.0 * abs(newton - s) < last;
  const Expr next_s = select(good, newton, 0.5 * (next_lo + next_hi));
  const Expr step = abs(next_s - s);

  loop.next(lo, next_lo);
  loop.next(hi, next_hi);
  loop.next(s, next_s);
  loop.next(last, step);
  loop.next(by_newton, good);
  loop.enter_if(changes);
  const double resolution = in_float ? 0x1p-25 : 0x1p-54;
  const Truth unfinished = step > resolution * abs(s) && next_hi - next_lo > resolution;
  if (!in_float) {
    loop.again_while(unfinished);
    return loop.result(s);
  }
  const Truth converges = good && by_newton && step < far_shorter * last;
  loop.again_while(unfinished && !(converges && step < enough_before_polish));

  Loop polish(program, "polish", 8);
  const Expr rough = polish.state("s", loop.result(s));
  const Expr better = rough - f.newton_in_double(rough);
  const Expr half_way = 0.5 * (rough + select(better < a, a, b));
  const Truth known = equal(better, better);
  const Expr next = select(known, select(a <= better && better <= b, better, half_way), rough);
  polish.next(rough, next);
  polish.enter_if(changes);
  polish.again_while(abs(next - rough) > enough_of_polish);
  return polish.result(rough);
}

}  // namespace imp
