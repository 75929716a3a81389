#include "passes/extend/inclusion.h"

#include <algorithm>

#include "ir/infinity.h"
#include "passes/extend/forms.h"

namespace imp {
namespace {

constexpr Inclusion table[] = {
    {"auto", "what is tight for its cost: slopes for polynomials, else intervals and affine forms",
     auto_form},
    {"ia", "the natural interval extension", interval_form},
    {"af1", "reduced affine arithmetic, a symbol for each variable", affine_form},
    {"af1-ia", "the same, intersected with interval arithmetic at every op", affine_and_interval_form},
    {"af2", "affine arithmetic with errors that know their sign", signed_affine_form},
    {"mean-value", "the mean value form: the value in the middle and the interval gradient", mean_value_form},
    {"taylor", "the Taylor form of order 2", taylor_form},
    {"cubic", "the form of cubic convergence along a ray", cubic_form},
    {"slope", "the value in the middle and slopes: tighter than mean-value", slope_form},
    {"bernstein", "the range of Bernstein coefficients, for polynomials only", bernstein_form},
};

}  // namespace

std::span<const Inclusion> inclusions() { return table; }

const Inclusion* inclusion_named(std::string_view name) {
  const auto* it = std::ranges::find(table, name, &Inclusion::name);
  return it == std::end(table) ? nullptr : it;
}

std::optional<Program> extension(const Program& f, Form& form, Type type, Diagnostics& diagnostics) {
  Program result{.name = f.name};
  Graph& graph = result.graph;
  std::vector<Interval> sides;
  std::vector<std::size_t> variables;
  Truth no_box = truth_of(graph, false);
  for (std::size_t i = 0; i < f.inputs.size(); ++i) {
    const Input& input = f.inputs[i];
    const Expr lo{&graph, add_input(result, input.name + "lo", f64, input.rate)};
    const Expr hi{&graph, add_input(result, input.name + "hi", f64, input.rate)};
    no_box = no_box || !(lo <= hi) || !(lo < infinity) || !(-infinity < hi);
    sides.push_back(type == f32 ? interval(narrow_up(-lo), narrow_up(hi)) : interval(-lo, hi));
    if (input.rate == Rate::ray) variables.push_back(i);
  }
  const auto values = form(f, {sides, variables}, diagnostics);
  if (!values) return std::nullopt;

  for (std::size_t i = 0; i < values->size(); ++i) {
    const Interval& value = (*values)[i];
    const std::string& name = f.outputs[i].name;
    const Truth empty = value.empty || no_box;
    const Expr lo = to(f64, value.lo()), hi = to(f64, value.hi);
    const Expr infinite = constant_like(hi, infinity);
    result.outputs.push_back({name + "lo", select(empty, infinite, lo).id});
    result.outputs.push_back({name + "hi", select(empty, -infinite, hi).id});
    result.outputs.push_back({name + "defined", (value.continuous && !empty).id});
  }
  return result;
}

}  // namespace imp
