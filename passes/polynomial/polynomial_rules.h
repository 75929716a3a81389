// Polynomials with interval coefficients as a number type that builds nodes.
#pragma once

#include <array>
#include <map>

#include "passes/extend/interval_rules.h"

namespace imp {

// The exponents of up to four variables; those there are not have exponent 0.
using Powers = std::array<std::uint32_t, 4>;

// A sum of coefficients times powers. What is not there is 0, and so is what is 0 for every input: it is
// never built. Where a coefficient is empty the sum has no value.
using Polynomial = std::map<Powers, Interval>;

Polynomial polynomial(const Interval& constant);

// An integer below 2^53, which may be no float.
Interval integer(Expr like, double value);

// n!/(i!k!…), with n = i + k + …, as long as it is below 2^53.
double multinomial(const Powers& powers);

// The new variable i times a coefficient.
Polynomial variable(std::size_t i, const Interval& coefficient);

// Polynomials in barycentric coordinates, whose sum is 1, can be kept homogeneous: that sum is then the unit, and
// by its powers a polynomial of lower degree is raised where it meets another. The coefficients over the
// multinomials are those in the Bernstein basis; all weights are positive, so nothing cancels but what cancels
// in f (Farouki and Rajan 1988).

// One rule an op of which polynomials are made, for ir/replay.h.
class PolynomialRules {
 public:
  using Value = Polynomial;

  // With an empty unit polynomials are as they come. The constants are of the type of `like`.
  PolynomialRules(Expr like, Polynomial unit)
      : none_(point(zero(like), {true, true})), unit_(std::move(unit)) {}

  std::uint32_t exponent = 0;  // of the powi at hand

  // Homogeneous of this degree, where there is a unit and `a` is of a lower one.
  Polynomial raised(const Polynomial& a, std::uint32_t degree) const;

  Polynomial add(const Polynomial& a, const Polynomial& b) const;
  Polynomial sub(const Polynomial& a, const Polynomial& b) const;
  Polynomial mul(const Polynomial& a, const Polynomial& b) const;
  Polynomial square(const Polynomial& a) const;
  Polynomial div(const Polynomial& a, const Polynomial& b) const;  // b constant
  Polynomial fma(const Polynomial& a, const Polynomial& b, const Polynomial& c) const;
  Polynomial neg(const Polynomial& a) const;
  Polynomial powi(const Polynomial& a, const Polynomial& n) const;  // by `exponent`

  // c is a constant: 1 where it may hold, 0 where it may fail.
  Polynomial select(const Polynomial& c, const Polynomial& a, const Polynomial& b) const;

 private:
  template <class Join>
  Polynomial termwise(const Polynomial& a, const Polynomial& b, Join join) const;
  Interval constant_of(const Polynomial& a) const;
  Polynomial power(const Polynomial& a, std::uint32_t n) const;
  Polynomial binomial_power(const Polynomial& a, std::uint32_t n) const;

  IntervalRules rules_;
  Interval none_;  // 0
  Polynomial unit_;
};

}  // namespace imp
