// Every surface of the catalogue, from its text to numbers: value, gradient and Hessian against the
// exact ones, before and after the kernel passes.
#include <gtest/gtest.h>

#include "frontend/model.h"
#include "ir/text.h"
#include "ir/verify.h"
#include "passes/differentiate.h"
#include "passes/elementary/lower.h"
#include "passes/pass.h"
#include "passes/precision.h"
#include "tests/support/catalogue.h"
#include "tests/support/error_scale.h"
#include "tests/support/evaluate.h"

namespace imp {
namespace {

std::array<double, 10> expected_of(const test::ValueRecord& v) {
  std::array<double, 10> all{v.f, v.gradient[0], v.gradient[1], v.gradient[2]};
  std::ranges::copy(v.hessian, all.begin() + 4);
  return all;
}

double largest(std::span<const double> values) {
  double result = 0;
  for (const double value : values)
    if (std::isfinite(value)) result = std::max(result, std::abs(value));
  return result;
}

class Catalogue : public testing::TestWithParam<std::size_t> {};

TEST_P(Catalogue, value_gradient_and_hessian) {
  const test::SurfaceEntry& entry = test::catalogue()[GetParam()];
  Diagnostics diagnostics;
  const auto model = parse_model(entry.source, entry.id + ".imp", diagnostics);
  ASSERT_TRUE(model) << to_text(diagnostics);
  const Program& f = model->surfaces.at(0).f;
  ASSERT_EQ(verify(f), "");
  const auto all = hessian(f, diagnostics);
  ASSERT_TRUE(all) << to_text(diagnostics);
  ASSERT_EQ(verify(*all), "");

  const Program numbers = in_precision(*all, f64);
  ASSERT_EQ(verify(numbers), "");
  const Program program = run_passes(numbers, kernel_passes());
  ASSERT_EQ(verify(program), "");
  const auto kernel = interpret(program), before = interpret(lower_elementary(numbers));

  for (const test::ValueRecord& record : entry.values) {
    const auto inputs = test::inputs_at(*model, record);
    const auto found = test::evaluate(*kernel, inputs), same = test::evaluate(*before, inputs);
    const auto expected = expected_of(record);
    std::array<double, 10> tolerance{};
    if (entry.kind == "algebraic") {
      const auto scales = test::error_scales(program, inputs);
      for (std::size_t i = 0; i < scales.size(); ++i) tolerance[i] = 1e-12 * scales[i];
    } else {
      const double slope = largest(record.gradient), bend = largest(record.hessian);
      tolerance.fill(1e-9 * (1 + bend));
      for (std::size_t i = 0; i < 4; ++i) tolerance[i] = 1e-9 * (1 + slope);
      tolerance[0] = 1e-9 * (1 + slope + std::abs(record.f));
    }
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_TRUE(test::same_bits(found[i], same[i])) << "the passes changed " << program.outputs[i].name;
      if (std::isnan(expected[i])) continue;
      EXPECT_NEAR(found[i], expected[i], tolerance[i])
          << program.outputs[i].name << " at " << testing::PrintToString(record.p);
    }
    if (HasFailure()) break;
  }
}

INSTANTIATE_TEST_SUITE_P(Surfaces, Catalogue, testing::Range(std::size_t{0}, test::catalogue().size()),
                         [](const auto& test) { return test::catalogue()[test.param].id; });

}  // namespace
}  // namespace imp
