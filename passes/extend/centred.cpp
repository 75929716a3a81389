#include "passes/extend/centred.h"

#include <limits>

#include "passes/differentiate.h"

namespace imp {
namespace {

// The midpoint of [lo, hi]: of what is finite of it, and never outside.
Expr midpoint(const Interval& side) {
  const Expr lo = side.lo(), hi = side.hi;
  if (side.facts.bounded) return min(hi, max(lo, 0.5 * lo + 0.5 * hi));
  const double largest = side.hi.type() == f32 ? static_cast<double>(std::numeric_limits<float>::max())
                                               : std::numeric_limits<double>::max();
  const Expr from = min(hi, max(lo, constant_like(lo, -largest)));
  const Expr to = max(lo, min(hi, constant_like(hi, largest)));
  return min(to, max(from, 0.5 * from + 0.5 * to));
}

}  // namespace

Centre centre_of(const InputBox& box) {
  Centre result{{box.sides.begin(), box.sides.end()}, {}};
  for (const std::size_t i : box.variables) {
    const Interval& side = box.sides[i];
    const Expr c = midpoint(side);
    result.sides[i] = point(c, {side.facts.nonnegative, true});
    result.radius.push_back(point(max(add_up(side.hi, -c), add_up(c, side.nlo)), {true, side.facts.bounded}));
  }
  return result;
}

Interval symmetric(Expr radius) { return interval(radius, radius); }
Interval one_sided(Expr radius) { return interval(zero(radius), radius, {.nonnegative = true}); }

Interval magnitude_of(const Interval& a) {
  return point(IntervalRules().abs(a).hi, {.nonnegative = true, .bounded = a.facts.bounded});
}

std::optional<Program> slopes_of(const Program& f, std::span<const std::size_t> variables,
                                 Diagnostics& diagnostics) {
  std::vector<std::string> names;
  for (const std::size_t i : variables) names.push_back(f.inputs[i].name);
  auto result = differentiate(f, std::vector<std::string_view>(names.begin(), names.end()), diagnostics);
  if (!result) return std::nullopt;
  result->outputs.erase(result->outputs.begin(),
                        result->outputs.end() - std::ssize(f.outputs) * std::ssize(variables));
  return result;
}

std::optional<std::vector<Program>> derivatives_of(const Program& f, std::span<const std::size_t> variables,
                                                   int orders, Diagnostics& diagnostics) {
  std::vector<Program> result;
  for (int order = 1; order <= orders; ++order) {
    auto next = slopes_of(result.empty() ? f : result.back(), variables, diagnostics);
    if (!next) return std::nullopt;
    result.push_back(*std::move(next));
  }
  return result;
}

Interval or_intervals(const Interval& f, Truth smooth, const Interval& centred) {
  const Truth holds = f.continuous && smooth;
  return {select(holds, min(centred.nlo, f.nlo), f.nlo),
          select(holds, min(centred.hi, f.hi), f.hi),
          f.empty,
          f.continuous,
          {}};
}

}  // namespace imp
