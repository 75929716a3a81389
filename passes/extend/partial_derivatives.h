// The partial derivatives of one op over ranges of its operands.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "passes/extend/interval_rules.h"

namespace imp {

// Enclosures of the derivatives of `op` in each of its operands, in order, over all points of the ranges
// where it has one. Nothing where the op has no derivative, or an interval rule is missing.
std::optional<std::vector<Interval>> partial_derivatives(Op op, std::span<const Interval> operands);

}  // namespace imp
