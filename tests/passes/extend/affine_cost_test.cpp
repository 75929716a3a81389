// What affine forms cost and bring on surfaces of the catalogue: the figures of docs/decisions/affine.md, as
// properties of the tests (--gtest_output=xml), and bounds of them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "passes/along_ray.h"
#include "passes/extend/forms.h"
#include "passes/pass.h"
#include "tests/support/catalogue.h"
#include "tests/support/cost.h"
#include "tests/support/evaluate.h"
#include "tests/support/make.h"
#include "tests/support/random.h"

namespace imp::test {
namespace {

constexpr double extent = 2;  // o, and s d in any direction

// The bounds of `f` (the variables first) in double: lo and hi of each variable, then points for the others.
Program bounds(const Program& f, Form& form, std::size_t variables) {
  Program result{.name = "bounds"};
  std::vector<Interval> sides;
  std::vector<std::size_t> symbols;
  std::vector<Range> domains;
  for (std::size_t i = 0; i < f.inputs.size(); ++i) {
    const Expr lo = input(result, fmt::format("lo{}", i), f64, f.inputs[i].rate);
    if (i < variables) symbols.push_back(i);
    sides.push_back(i < variables ? interval(-lo, input(result, fmt::format("hi{}", i), f64)) : point(lo));
    domains.push_back({-100, 100});
  }
  Diagnostics diagnostics;
  const auto values = form(f, {sides, symbols, domains}, diagnostics);
  if (!values) throw std::runtime_error(to_text(diagnostics));
  output(result, "lo", values->front().lo());
  output(result, "hi", values->front().hi);
  return run_passes(compact(result), kernel_passes());
}

// Geometric mean of the widths of `a` over those of `b` on random boxes: sides of `width` and points.
double ratio(const Program& a, const Program& b, const Program& f, std::size_t variables,
             std::span<const double> uniforms, double width) {
  const auto first = interpret(a), second = interpret(b);
  Random random(1);
  double sum = 0;
  int count = 0;
  for (int i = 0; i < 200; ++i) {
    std::vector<double> numbers;
    for (std::size_t k = 0; k < f.inputs.size() - uniforms.size(); ++k) {
      const double lo = random.between(k < variables && variables == 1 ? 0 : -extent, extent / 2);
      numbers.push_back(lo);
      if (k < variables) numbers.push_back(lo + width);
    }
    numbers.insert(numbers.end(), uniforms.begin(), uniforms.end());
    const auto p = evaluate(*first, numbers), q = evaluate(*second, numbers);
    const double log = std::log((p[1] - p[0]) / (q[1] - q[0]));
    if (!std::isfinite(log)) continue;
    sum += log, ++count;
  }
  return std::exp(sum / count);
}

class AffineCost : public testing::TestWithParam<const char*> {};

TEST_P(AffineCost, is_no_wider_on_small_boxes) {
  const Model model = model_of(entry_named(GetParam()));
  const Program& f = model.surfaces[0].f;
  const auto at_origin = inputs_at(model, {});
  const std::span<const double> uniforms = std::span(at_origin).subspan(3);
  const struct {
    const char* name;
    Program f;
    std::size_t variables;
  } ways[] = {{"ray", along_ray(f), 1}, {"box", f, 3}};
  for (const auto& [name, of, variables] : ways) {
    const Program intervals = bounds(of, interval_form, variables);
    const Program forms = bounds(of, affine_form, variables);
    const double wide = ratio(forms, intervals, of, variables, uniforms, 0x1p-3);
    const double narrow = ratio(forms, intervals, of, variables, uniforms, 0x1p-6);
    RecordProperty(name,
                   fmt::format("{} | {} | {:.2f} | {:.2f}", cost(intervals), cost(forms), wide, narrow));
    EXPECT_LT(cost(forms), 8 * cost(intervals));
    EXPECT_LT(narrow, 1.05);
    EXPECT_LT(narrow, 1.02 * wide);
  }
}

INSTANTIATE_TEST_SUITE_P(Surfaces, AffineCost,
                         testing::Values("sphere", "torus_sqrt", "tangle", "klein_bottle", "mitchell",
                                         "steiner", "decocube", "superquadric_knoll", "barth_sextic",
                                         "barth_decic", "blinn_gauss", "sin_blob", "cloth", "scherk",
                                         "heart_beam"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace imp::test
