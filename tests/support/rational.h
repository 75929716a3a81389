// Polynomials in one variable with rational coefficients, and a Program run over them: nothing is rounded.
#pragma once

#include <gmpxx.h>

#include <stdexcept>
#include <vector>

#include "ir/program.h"
#include "ir/replay.h"

namespace imp::test {

using Rational = mpq_class;
using RationalPolynomial = std::vector<Rational>;  // by powers; none is 0

class RationalRules {
 public:
  using Value = RationalPolynomial;

  Value add(const Value& a, const Value& b) const {
    Value sum(std::max(a.size(), b.size()));
    for (std::size_t i = 0; i < a.size(); ++i) sum[i] += a[i];
    for (std::size_t i = 0; i < b.size(); ++i) sum[i] += b[i];
    return sum;
  }
  Value mul(const Value& a, const Value& b) const {
    if (a.empty() || b.empty()) return {};
    Value product(a.size() + b.size() - 1);
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t k = 0; k < b.size(); ++k) product[i + k] += a[i] * b[k];
    return product;
  }
  Value neg(const Value& a) const { return mul(a, {Rational(-1)}); }
  Value sub(const Value& a, const Value& b) const { return add(a, neg(b)); }
  Value fma(const Value& a, const Value& b, const Value& c) const { return add(mul(a, b), c); }
  Value div(const Value& a, const Value& b) const {
    if (b.size() != 1) throw std::runtime_error("division by no constant");
    return mul(a, {1 / b[0]});
  }
  Value powi(const Value& a, const Value& n) const {
    Value product{Rational(1)};
    for (Rational k = 0; k < (n.empty() ? Rational(0) : n[0]); ++k) product = mul(product, a);
    return product;
  }
};

inline RationalPolynomial constant(double value) { return {Rational(value)}; }

// The first output of a Program of polynomials.
inline RationalPolynomial run_exactly(const Program& f, const std::vector<RationalPolynomial>& inputs) {
  RationalRules rules;
  std::vector<RationalPolynomial> values, args;
  for (std::uint32_t i = 0; i < f.graph.size(); ++i) {
    const Node node = f.graph[Id{i}];
    args.clear();
    for (const Id arg : node.args) args.push_back(values[arg.index]);
    if (node.op == Op::input)
      values.push_back(inputs[node.payload]);
    else if (const auto number = f.graph.number(Id{i}))
      values.push_back(constant(*number));
    else
      values.push_back(apply(rules, node.op, std::span<const RationalPolynomial>(args)).value());
  }
  return values[f.outputs[0].id.index];
}

inline Rational binomial(std::size_t n, std::size_t k) {
  Rational result = 1;
  for (std::size_t i = 0; i < k; ++i)
    result *= Rational(static_cast<unsigned long>(n - i)) / static_cast<unsigned long>(i + 1);
  return result;
}

// The Bernstein coefficients of degree `degree` over [0, 1].
inline std::vector<Rational> bernstein_of(const RationalPolynomial& powers, std::size_t degree) {
  std::vector<Rational> result(degree + 1);
  for (std::size_t i = 0; i <= degree; ++i)
    for (std::size_t k = 0; k <= i && k < powers.size(); ++k)
      result[i] += binomial(i, k) / binomial(degree, k) * powers[k];
  return result;
}

// Whether lo <= value <= hi.
inline bool lies_in(const Rational& value, double lo, double hi) {
  return (std::isinf(lo) ? lo < 0 : Rational(lo) <= value) &&
         (std::isinf(hi) ? hi > 0 : value <= Rational(hi));
}

}  // namespace imp::test
