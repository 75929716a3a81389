// Division through zero: the solutions x of n = d x, for n and d anywhere in two intervals (Hansen and Walster 2004;
// mulRevToPair of IEEE 1788).
#pragma once

#include "passes/extend/interval_rules.h"

namespace imp {

// What lies on either side of 0. A numerator without 0 keeps a gap around 0, where IntervalRules::div answers all
// reals: 1 = d x for d in [-1, 2] holds on (-∞, -1] and [1/2, ∞). Where both intervals hold 0, all reals do.
struct HalfLines {
  Interval below, above;  // x <= 0 and x >= 0; together they hold every solution
};

// NaN at an end of an operand says nothing of that end.
HalfLines half_lines(const Interval& numerator, const Interval& divisor);

}  // namespace imp
