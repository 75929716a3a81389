// The power basis: the coefficients of a polynomial, with every rounding in them.
#pragma once

#include "passes/extend/inclusion.h"
#include "passes/polynomial/polynomial_rules.h"

namespace imp {

// What stands for the variables of a box: a polynomial in new variables for each and, where all are to be
// homogeneous, the unit of PolynomialRules.
struct Substitution {
  std::vector<Polynomial> places;
  Polynomial unit{};
};

// The outputs of `f` (f64, constants unresolved) in the new variables. The sides of the variables of the box are not
// looked at. Where all coefficients are continuous f is defined and continuous. Errors point at what makes f no
// polynomial or has no interval rule, or say that there are too many coefficients.
std::optional<std::vector<Polynomial>> power_basis(const Program& f, const InputBox& box,
                                                   const Substitution& substitution,
                                                   Diagnostics& diagnostics);

// The coefficients of 1, u, …, u^degree, of a polynomial in one variable; of the type of `like`.
std::vector<Interval> in_order(const Polynomial& polynomial, std::uint32_t degree, Expr like);

}  // namespace imp
