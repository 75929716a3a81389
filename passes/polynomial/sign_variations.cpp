#include "passes/polynomial/sign_variations.h"

#include "ir/assert.h"

namespace imp {

// The most variations so far in which the last sign is a plus, and a minus; below 0: there is none such.
// Taking a sign that may be 0 for one never makes fewer.
Expr most_sign_variations(std::span<const Interval> coefficients) {
  IMP_ASSERT(!coefficients.empty(), "a coefficient");
  const Expr like = coefficients[0].hi, none = zero(like);
  const Expr never = constant_like(like, -2 * static_cast<double>(coefficients.size()));
  Expr plus = never, minus = never;
  for (const Interval& b : coefficients) {
    const Truth may_be_plus = !(b.hi <= 0), may_be_minus = !(b.nlo <= 0);
    const Expr to_plus = max(max(plus, minus + 1.0), none), to_minus = max(max(minus, plus + 1.0), none);
    plus = select(may_be_plus, to_plus, select(b.hi < 0, never, plus));
    minus = select(may_be_minus, to_minus, select(b.nlo < 0, never, minus));
  }
  return max(max(plus, minus), none);
}

}  // namespace imp
