// What centred forms share: the middle of a box, how far the box reaches from it, and what stands in
// where a form does not hold.
#pragma once

#include "ir/program.h"
#include "passes/extend/inclusion.h"

namespace imp {

struct Centre {
  std::vector<Interval> sides;   // those of the box, the variables' replaced by their middles c, which are
                                 // finite points of the box
  std::vector<Interval> radius;  // of each variable: every x of the box has |x - c| <= radius.hi, a point
};

Centre centre_of(const InputBox& box);

// The sets r[-1, 1] and r[0, 1], for r >= 0.
Interval symmetric(Expr radius);
Interval one_sided(Expr radius);

// The largest |a|, as a point.
Interval magnitude_of(const Interval& a);

// The partial derivatives of the outputs of `f` in the variables: of the first output in each of them, then of
// the second, ….
std::optional<Program> slopes_of(const Program& f, std::span<const std::size_t> variables,
                                 Diagnostics& diagnostics);

// All derivatives up to an order: by slopes_of those of f, then those of these, ….
std::optional<std::vector<Program>> derivatives_of(const Program& f, std::span<const std::size_t> variables,
                                                   int orders, Diagnostics& diagnostics);

// `centred` and `f`, the interval form of the same, intersected where `f` says that f is continuous and `smooth`
// that its slopes are enclosed; else `f` alone. The flags are those of `f`.
Interval or_intervals(const Interval& f, Truth smooth, const Interval& centred);

}  // namespace imp
