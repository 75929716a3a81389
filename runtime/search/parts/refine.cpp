#include "runtime/search/parts/refine.h"

#include "ir/loop.h"

namespace imp {

Expr refine(Program& program, const RayFunction& f, Expr a, Expr b, Expr sign_a, Truth enter) {
  const double resolution = f.like.type() == f32 ? 0x1p-25 : 0x1p-54;

  Loop loop(program, "refine", f.like.type() == f32 ? 24 : 64);
  const Expr lo = loop.state("lo", a);
  const Expr hi = loop.state("hi", b);
  const Expr s = loop.state("s", 0.5 * (a + b));
  const Expr last = loop.state("last", b - a);  // the length of the last step

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
  loop.enter_if(enter);
  loop.again_while(step > resolution * abs(s) && next_hi - next_lo > resolution);
  if (f.like.type() != f32) return loop.result(s);

  Loop polish(program, "polish", 3);
  const Expr rough = polish.state("s", loop.result(s));
  const Expr better = rough - f.newton_in_double(rough);
  polish.next(rough, select(a <= better && better <= b, better, rough));
  polish.enter_if(enter);
  polish.again_while(truth_of(program.graph, true));
  return polish.result(rough);
}

}  // namespace imp
