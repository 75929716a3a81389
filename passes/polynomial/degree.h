// Degrees: is f a polynomial in some of its inputs, and of which degree?
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "ir/diagnostics.h"
#include "ir/program.h"

namespace imp {

// What the degrees of a polynomial are at most (leading terms may cancel). No degree is above 2^30, which
// stands for all beyond.
struct Degree {
  std::uint32_t total = 0;
  std::vector<std::uint32_t> in;  // in each variable
};

// Of each output of `f` (f64, constants unresolved) as a polynomial in the inputs `variables`; the other
// inputs are coefficients, of which it need not be one. Errors point at the op that makes it none.
std::optional<std::vector<Degree>> degrees(const Program& f, std::span<const std::size_t> variables,
                                           Diagnostics& diagnostics);

// For each node whether one of the inputs `variables` is an operand, or an operand of an operand, …
std::vector<bool> depends_on(const Program& f, std::span<const std::size_t> variables);

// "x, y, z"
std::string names_of(const Program& f, std::span<const std::size_t> variables);

}  // namespace imp
