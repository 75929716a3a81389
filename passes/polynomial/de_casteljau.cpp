#include "passes/polynomial/de_casteljau.h"

namespace imp {
namespace {

// The triangle of means of neighbours: downward along its left side, upward along its right.
template <class Mean>
Halves triangle(std::span<const Interval> coefficients, Mean mean) {
  std::vector<Interval> row(coefficients.begin(), coefficients.end());
  Halves result{row, row};
  for (std::size_t level = 0; !row.empty(); ++level) {
    result.left[level] = row.front();
    result.right[row.size() - 1] = row.back();
    for (std::size_t i = 0; i + 1 < row.size(); ++i) row[i] = mean(row[i], row[i + 1]);
    row.pop_back();
  }
  return result;
}

}  // namespace

Halves split(std::span<const Interval> coefficients, const Interval& at) {
  const IntervalRules rules;
  Interval rest = rules.sub(point(one(at.hi), {true, true}), at);
  rest.nlo = min(rest.nlo, zero(rest.nlo));
  rest.facts.nonnegative = true;
  return triangle(coefficients, [&](const Interval& a, const Interval& b) {
    return rules.add(rules.mul(rest, a), rules.mul(at, b));
  });
}

Halves split_in_the_middle(std::span<const Interval> coefficients) {
  return triangle(coefficients, [&](const Interval& a, const Interval& b) {
    const IntervalRules rules;
    return rules.mul(rules.add(a, b), point(constant_like(a.hi, 0.5), {true, true}));
  });
}

// Weights that are not negative keep the ends of an interval where they are. inf times 0 is NaN: not known.
Halves split_at(std::span<const Interval> coefficients, Expr at, Expr rest) {
  return triangle(coefficients, [&](const Interval& a, const Interval& b) {
    const auto mean = [&](Expr p, Expr q) { return fma_up(at, q, mul_up(rest, p)); };
    return Interval{
        mean(a.nlo, b.nlo), mean(a.hi, b.hi), a.empty || b.empty, a.continuous && b.continuous, {}};
  });
}

}  // namespace imp
