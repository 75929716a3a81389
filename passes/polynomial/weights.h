// Linear maps with constant coefficients, which need not be floats: changes of basis.
#pragma once

#include <span>
#include <vector>

#include "passes/extend/interval_rules.h"
#include "passes/multiprecision.h"

namespace imp {

// A constant as a number of a kernel's type, from which it differs by `error` at most.
struct Weight {
  double value, error;
};

Weight weight(const BigInterval& constant, Type type);

using Matrix = std::vector<std::vector<Weight>>;  // by rows

// The sum of the products, where one has both weight and error 0 left out; not all have.
Interval weighted_sum(std::span<const Weight> weights, std::span<const Interval> terms);

}  // namespace imp
