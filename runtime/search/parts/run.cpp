#include "runtime/search/parts/run.h"

namespace imp {

Truth monotone(const RayFunction& f, Expr a, Expr b) {
  const Interval slope = f.slope_bound(interval(-a, b, {.nonnegative = true, .bounded = true}));
  return !may_be_zero(slope) && slope.continuous;
}

Found answer(const RayFunction& f, const Run& run, Truth miss, Expr steps) {
  const Expr a = run.a, b = run.b;
  const Truth changes = run.found && run.before * run.after < 0;
  const Truth hit = changes && (b - a <= certified_length || run.single) && run.smooth;
  const Truth certain_miss = !f.exists || miss;

  return {select(hit, constant_like(a, verdict_hit),
                 select(certain_miss, constant_like(a, verdict_miss), constant_like(a, verdict_undecided))),
          run.found,
          {a, b, run.before, changes},
          steps};
}

}  // namespace imp
