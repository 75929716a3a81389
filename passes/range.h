// Range analysis: what the nodes of a Program can be over a domain, known before anything runs.
// It is the interval extension at a constant box: every node folds.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "ir/program.h"

namespace imp {

struct Range {
  double lo, hi;  // lo > hi: no value

  bool bounded_by(double limit) const { return -limit < lo && hi < limit; }
};

inline constexpr Range everything{-__builtin_huge_val(), __builtin_huge_val()};

// For every number node the enclosure of its values over the box of the inputs, one Range each, in
// order; nothing for truths and for ops that the interval extension cannot bound.
std::vector<std::optional<Range>> ranges(const Program& program, std::span<const Range> inputs);

}  // namespace imp
