#include "passes/polynomial/polynomial_rules.h"

#include <algorithm>
#include <numeric>

#include "ir/assert.h"

namespace imp {
namespace {

bool is_zero(const Interval& a) {
  const Graph& graph = *a.hi.graph;
  return graph.number(a.nlo.id) == 0.0 && graph.number(a.hi.id) == 0.0 &&
         graph.truth_value(a.empty.id) == false && graph.truth_value(a.continuous.id) == true;
}

Powers plus(Powers a, const Powers& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
  return a;
}

Powers times(Powers a, std::uint32_t n) {
  for (std::uint32_t& power : a) power *= n;
  return a;
}

// Of a homogeneous polynomial that is not 0.
std::uint32_t degree_of(const Polynomial& a) {
  const Powers& powers = a.begin()->first;
  return std::accumulate(powers.begin(), powers.end(), 0u);
}

void accumulate(const IntervalRules& rules, Polynomial& sum, const Powers& powers, const Interval& value) {
  const auto [it, fresh] = sum.try_emplace(powers, value);
  if (!fresh) it->second = rules.add(it->second, value);
}

Polynomial without_zeros(Polynomial a) {
  std::erase_if(a, [](const auto& term) { return is_zero(term.second); });
  return a;
}

}  // namespace

Polynomial polynomial(const Interval& constant) { return without_zeros({{Powers{}, constant}}); }

Interval integer(Expr like, double value) {
  Graph& graph = *like.graph;
  return interval(rounded_up(graph, like.type(), -value), rounded_up(graph, like.type(), value),
                  {value >= 0, true});
}

double multinomial(const Powers& powers) {
  double result = 1, n = 0;
  for (const std::uint32_t power : powers)
    for (std::uint32_t k = 1; k <= power; ++k) result = result * ++n / k;
  return result;
}

Polynomial variable(std::size_t i, const Interval& coefficient) {
  Powers powers{};
  powers[i] = 1;
  return without_zeros({{powers, coefficient}});
}

Polynomial PolynomialRules::raised(const Polynomial& a, std::uint32_t degree) const {
  if (unit_.empty() || a.empty() || degree_of(a) >= degree) return a;
  return mul(a, power(unit_, degree - degree_of(a)));
}

// `join` of each pair of coefficients, of which one may be 0.
template <class Join>
Polynomial PolynomialRules::termwise(const Polynomial& a, const Polynomial& b, Join join) const {
  const std::uint32_t degree = a.empty() || b.empty() ? 0 : std::max(degree_of(a), degree_of(b));
  const Polynomial p = raised(a, degree), q = raised(b, degree);
  const auto in = [&](const Polynomial& sum, const Powers& powers) {
    const auto it = sum.find(powers);
    return it == sum.end() ? none_ : it->second;
  };
  Polynomial result;
  for (const Polynomial* sum : {&p, &q})
    for (const auto& [powers, unused] : *sum)
      if (!result.contains(powers)) result.emplace(powers, join(in(p, powers), in(q, powers)));
  return without_zeros(std::move(result));
}

Polynomial PolynomialRules::add(const Polynomial& a, const Polynomial& b) const {
  return termwise(a, b, [&](const Interval& p, const Interval& q) { return rules_.add(p, q); });
}

Polynomial PolynomialRules::sub(const Polynomial& a, const Polynomial& b) const {
  return termwise(a, b, [&](const Interval& p, const Interval& q) { return rules_.sub(p, q); });
}

Polynomial PolynomialRules::mul(const Polynomial& a, const Polynomial& b) const {
  Polynomial product;
  if (a.empty() || b.empty()) {  // 0, where the other one has a value
    for (const auto& [powers, value] : a.empty() ? b : a) product.emplace(powers, rules_.mul(value, none_));
    return without_zeros(std::move(product));
  }
  for (const auto& [i, p] : a)
    for (const auto& [k, q] : b) accumulate(rules_, product, plus(i, k), rules_.mul(p, q));
  return without_zeros(std::move(product));
}

// The squares have a sign, and the mixed products come in pairs.
Polynomial PolynomialRules::square(const Polynomial& a) const {
  Polynomial mixed;
  for (auto p = a.begin(); p != a.end(); ++p)
    for (auto q = std::next(p); q != a.end(); ++q)
      accumulate(rules_, mixed, plus(p->first, q->first), rules_.mul(p->second, q->second));
  Polynomial result;
  for (const auto& [powers, value] : mixed) result.emplace(powers, rules_.mul(value, integer(none_.hi, 2)));
  for (const auto& [powers, value] : a) accumulate(rules_, result, times(powers, 2), rules_.square(value));
  return without_zeros(std::move(result));
}

Polynomial PolynomialRules::div(const Polynomial& a, const Polynomial& b) const {
  const Interval divisor = constant_of(b);
  if (a.empty()) return polynomial(rules_.div(none_, divisor));
  Polynomial result;
  for (const auto& [powers, value] : a) result.emplace(powers, rules_.div(value, divisor));
  return without_zeros(std::move(result));
}

Polynomial PolynomialRules::fma(const Polynomial& a, const Polynomial& b, const Polynomial& c) const {
  return add(mul(a, b), c);
}

Polynomial PolynomialRules::neg(const Polynomial& a) const {
  Polynomial result;
  for (const auto& [powers, value] : a) result.emplace(powers, rules_.neg(value));
  return result;
}

Polynomial PolynomialRules::powi(const Polynomial& a, const Polynomial&) const { return power(a, exponent); }

Polynomial PolynomialRules::power(const Polynomial& a, std::uint32_t n) const {
  if (n == 0) {  // 1, where a has a value
    Interval unit = integer(none_.hi, 1);
    for (const auto& [powers, value] : a) {
      unit.empty = unit.empty || value.empty;
      unit.continuous = unit.continuous && value.continuous;
    }
    return polynomial(unit);
  }
  if (n == 1 || a.empty()) return a;
  if (a.size() <= 2) return binomial_power(a, n);
  const Polynomial half = square(power(a, n / 2));
  return n % 2 == 1 ? mul(half, a) : half;
}

// (p + q)^n by the binomial theorem: each coefficient is one product of powers, which know their sign.
Polynomial PolynomialRules::binomial_power(const Polynomial& a, std::uint32_t n) const {
  const auto& [i, p] = *a.begin();
  if (a.size() == 1) return without_zeros({{times(i, n), rules_.powi(p, integer(none_.hi, n))}});
  const auto& [k, q] = *std::next(a.begin());
  Polynomial result;
  for (std::uint32_t m = 0; m <= n; ++m) {
    Interval term = integer(none_.hi, multinomial({n - m, m}));
    if (m < n) term = rules_.mul(rules_.powi(p, integer(none_.hi, n - m)), term);
    if (m > 0) term = rules_.mul(rules_.powi(q, integer(none_.hi, m)), term);
    accumulate(rules_, result, plus(times(i, n - m), times(k, m)), term);
  }
  return without_zeros(std::move(result));
}

Polynomial PolynomialRules::select(const Polynomial& c, const Polynomial& a, const Polynomial& b) const {
  const Interval holds = constant_of(c);
  const Possible condition{!holds.empty && holds.hi > 0.5, !holds.empty && holds.lo() < 0.5};
  return termwise(a, b, [&](const Interval& p, const Interval& q) { return rules_.select(condition, p, q); });
}

Interval PolynomialRules::constant_of(const Polynomial& a) const {
  IMP_ASSERT(a.empty() || (a.size() == 1 && a.begin()->first == Powers{}), "a constant");
  return a.empty() ? none_ : a.begin()->second;
}

}  // namespace imp
