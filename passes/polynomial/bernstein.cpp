#include "passes/polynomial/bernstein.h"

#include "ir/assert.h"
#include "passes/extend/interval.h"
#include "passes/polynomial/basis.h"
#include "passes/polynomial/power_basis.h"

namespace imp {
namespace {

constexpr std::size_t most_points = 343;      // so much code is still compiled in seconds
constexpr std::uint32_t highest_degree = 32;  // beyond, not even double knows a digit of the result

Interval lower_end(const Interval& side) { return interval(side.nlo, -side.nlo, side.facts); }
Interval upper_end(const Interval& side) { return interval(-side.hi, side.hi, side.facts); }
Interval width(const Interval& side) { return IntervalRules().sub(upper_end(side), lower_end(side)); }

// lo + t (hi - lo), which lies in the side.
Interval position(const Interval& side, double t) {
  if (t == 0) return lower_end(side);
  if (t == 1) return upper_end(side);
  const IntervalRules rules;
  const Interval share = point(constant_like(side.hi, t), {true, true});
  const Interval at = rules.add(lower_end(side), rules.mul(width(side), share));
  return interval(min(at.nlo, side.nlo), min(at.hi, side.hi), side.facts);
}

std::size_t product(std::span<const std::uint32_t> degrees) {
  std::size_t count = 1;
  for (const std::uint32_t degree : degrees) count *= degree + 1;
  return count;
}

// The values of f (one output) at the points of the grid.
std::optional<std::vector<Interval>> sample(const Program& f, const InputBox& box,
                                            std::span<const std::uint32_t> degrees,
                                            Diagnostics& diagnostics) {
  std::vector<Interval> values, inputs(box.sides.begin(), box.sides.end());
  for (std::size_t k = 0, count = product(degrees); k < count; ++k) {
    std::size_t index = k;
    for (std::size_t i = 0; i < degrees.size(); ++i) {
      const std::size_t points = degrees[i] + 1;
      inputs[box.variables[i]] =
          position(box.sides[box.variables[i]], sample_points(degrees[i])[index % points]);
      index /= points;
    }
    const auto value = enclose(f, inputs, diagnostics, box.domain);
    if (!value) return std::nullopt;
    values.push_back(value->front());
  }
  return values;
}

// `values` with the matrix applied to every line along an axis, on which values lie `stride` apart.
std::vector<Interval> transformed(const std::vector<Interval>& values, const Matrix& matrix,
                                  std::size_t stride) {
  std::vector<Interval> result = values, line(matrix.size(), values[0]);
  for (std::size_t first = 0; first < values.size(); ++first) {
    if (first / stride % matrix.size() != 0) continue;
    for (std::size_t i = 0; i < line.size(); ++i) line[i] = values[first + i * stride];
    for (std::size_t i = 0; i < line.size(); ++i) result[first + i * stride] = weighted_sum(matrix[i], line);
  }
  return result;
}

std::optional<Bernstein> of_one_output(const Program& f, const InputBox& box, const Degree& degree,
                                       Diagnostics& diagnostics) {
  auto values = sample(f, box, degree.in, diagnostics);
  if (!values) return std::nullopt;
  std::size_t stride = 1;
  for (const std::uint32_t n : degree.in) {
    values = transformed(*values, from_samples(n, values->front().hi.type()), stride);
    stride *= n + 1;
  }
  return Bernstein{degree.in, *std::move(values)};
}

// Whether the points are few enough.
bool is_small(const Program& f, const Degree& degree, const Output& output,
              std::span<const std::size_t> variables, Diagnostics& diagnostics) {
  std::string points;
  bool small = true;
  std::size_t count = 1;
  for (const std::uint32_t n : degree.in) {
    small = small && n <= highest_degree && (count *= n + 1) <= most_points;
    points += (points.empty() ? "" : "*") + std::to_string(n + 1);
  }
  if (!small)
    diagnostics.error(f.graph.span(output.id),
                      "the Bernstein form of this polynomial in " + names_of(f, variables) + " takes " +
                          points + " values of it: at most " + std::to_string(highest_degree + 1) +
                          " an axis and " + std::to_string(most_points) + " in all are taken");
  return small;
}

}  // namespace

std::optional<std::vector<Bernstein>> bernstein_by_samples(const Program& f, const InputBox& box,
                                                           Diagnostics& diagnostics) {
  const auto found = degrees(f, box.variables, diagnostics);
  if (!found) return std::nullopt;
  std::vector<Bernstein> result;
  for (std::size_t i = 0; i < f.outputs.size(); ++i) {
    if (!is_small(f, (*found)[i], f.outputs[i], box.variables, diagnostics)) return std::nullopt;
    Program one = f;
    one.outputs = {f.outputs[i]};
    auto coefficients = of_one_output(compact(one), box, (*found)[i], diagnostics);
    if (!coefficients) return std::nullopt;
    result.push_back(*std::move(coefficients));
  }
  return result;
}

std::optional<std::vector<Bernstein>> bernstein_by_powers(const Program& f, const InputBox& box,
                                                          Diagnostics& diagnostics) {
  IMP_ASSERT(box.variables.size() == 1, "one variable");
  const Interval& side = box.sides[box.variables[0]];
  Polynomial place = polynomial(lower_end(side));
  place.merge(variable(0, width(side)));
  const auto found = degrees(f, box.variables, diagnostics);
  const auto powers = found ? power_basis(f, box, {{place}}, diagnostics) : std::nullopt;
  if (!powers) return std::nullopt;
  std::vector<Bernstein> result;
  for (std::size_t i = 0; i < powers->size(); ++i) {
    const std::uint32_t degree = (*found)[i].total;
    const auto terms = in_order((*powers)[i], degree, side.hi);
    result.push_back({{degree}, {}});
    for (const auto& row : from_powers(degree, side.hi.type()))
      result.back().coefficients.push_back(weighted_sum(row, terms));
  }
  return result;
}

// Where s is in [lo, hi] it is lo (1 - u) + hi u.
std::optional<std::vector<Bernstein>> bernstein_by_products(const Program& f, const InputBox& box,
                                                            Diagnostics& diagnostics) {
  IMP_ASSERT(box.variables.size() == 1, "one variable");
  const Interval& side = box.sides[box.variables[0]];
  const Interval unit = point(one(side.hi), {true, true});
  Substitution substitution{{variable(0, upper_end(side))}, variable(0, unit)};
  substitution.places[0].merge(variable(1, lower_end(side)));
  substitution.unit.merge(variable(1, unit));
  const auto found = degrees(f, box.variables, diagnostics);
  const auto products = found ? power_basis(f, box, substitution, diagnostics) : std::nullopt;
  if (!products) return std::nullopt;
  std::vector<Bernstein> result;
  for (std::size_t i = 0; i < products->size(); ++i) {
    const std::uint32_t degree = (*found)[i].total;
    auto terms = in_order((*products)[i], degree, side.hi);
    for (std::uint32_t k = 0; k <= degree; ++k)
      terms[k] = IntervalRules().div(terms[k], integer(side.hi, multinomial({k, degree - k})));
    result.push_back({{degree}, std::move(terms)});
  }
  return result;
}

Interval range_of(std::span<const Interval> coefficients) {
  Interval result = coefficients.front();
  result.facts = {};
  for (const Interval& b : coefficients.subspan(1))
    result = {max(b.nlo, result.nlo),
              max(b.hi, result.hi),
              b.empty || result.empty,
              b.continuous && result.continuous,
              {}};
  return result;
}

}  // namespace imp
