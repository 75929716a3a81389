#include "runtime/search/parts/run.h"

namespace imp {

RunStates run_states(Program& program, Loop& loop, Expr like) {
  const Expr unknown = zero(like);
  const Truth open = loop.state("open", truth_of(program.graph, false));
  const Expr start = loop.state("run", unknown), slope = loop.state("slope", unknown);
  const Expr before = loop.state("before", unknown), after = loop.state("after", unknown);
  return {open, start, slope, before, after, loop.state("smooth", truth_of(program.graph, true))};
}

Run run_after(const Loop& loop, const RunStates& states, Expr end) {
  return {.found = loop.result(states.open),
          .a = loop.result(states.start),
          .b = loop.result(end),
          .before = loop.result(states.before),
          .after = loop.result(states.after),
          .smooth = loop.result(states.smooth),
          .single = abs(loop.result(states.slope)) > 0};
}

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
