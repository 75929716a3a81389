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
// order, as a kernel of type `type` computes it: so no box within ever gives wider bounds there, and
// what is finite here never overflows. Nothing for truths and for ops that have no interval rule.
std::vector<std::optional<Range>> ranges(const Program& program, std::span<const Range> inputs,
                                         Type type = f64);

}  // namespace imp
