// De Casteljau's algorithm: Bernstein coefficients over the parts of a piece, from those over the whole.
#pragma once

#include <span>
#include <vector>

#include "passes/extend/interval_rules.h"

namespace imp {

struct Halves {
  std::vector<Interval> left, right;  // over [0, at] and [at, 1]
};

// `at` lies in [0, 1].
Halves split(std::span<const Interval> coefficients, const Interval& at);
Halves split_in_the_middle(std::span<const Interval> coefficients);

// At a number in [0, 1], where `rest` is exactly 1 - at: a third of the ops.
Halves split_at(std::span<const Interval> coefficients, Expr at, Expr rest);

}  // namespace imp
