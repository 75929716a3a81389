#include "passes/polynomial/sign_variations.h"

#include "ir/assert.h"

namespace imp {

// The most variations so far in which the last sign is a plus, and a minus; -1: there was none such. Taking a sign that
// may be 0 for one never makes fewer. Behind a certain minus what ended in a plus is at least one behind, and stays so.
Expr most_sign_variations(std::span<const Interval> coefficients) {
  IMP_ASSERT(!coefficients.empty(), "a coefficient");
  const Expr none = constant_like(coefficients[0].hi, -1);
  Expr plus = none, minus = none;
  for (const Interval& b : coefficients) {
    const Expr to_plus = max(plus, minus + 1.0), to_minus = max(minus, plus + 1.0);
    plus = select(!(b.hi <= 0), to_plus, plus);
    minus = select(!(b.nlo <= 0), to_minus, minus);
  }
  return max(max(plus, minus), none + 1.0);
}

}  // namespace imp
