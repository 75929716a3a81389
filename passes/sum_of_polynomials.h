// A view of a node as a constant and polynomials, each in one sub-expression: what recognition and
// economisation look at.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "ir/program.h"
#include "passes/multiprecision.h"

namespace imp {

// Of powers 1, 2, … of an atom: coefficients[0] is that of the atom itself. Those that 160 bits hold are
// points; the last is not 0.
using Coefficients = std::vector<BigInterval>;

struct SumOfPolynomials {
  BigInterval constant;
  std::map<Id, Coefficients> parts;  // by the atom, a node of the Program

  // The one atom, where there is no other.
  std::optional<Id> only_atom() const {
    return parts.size() == 1 ? std::optional(parts.begin()->first) : std::nullopt;
  }
};

inline constexpr std::size_t largest_polynomial_degree = 100;

// For every number node of `f` its view. A node is an atom where it is neither a sum of polynomials, each in
// one of `most_atoms` atoms, nor a product of polynomials in one atom; or where the degree is beyond
// `largest_polynomial_degree`.
std::vector<std::optional<SumOfPolynomials>> sums_of_polynomials(const Program& f, std::size_t most_atoms);

}  // namespace imp
