// Enclosures of formulas put together at random, with constants that overflow, underflow, vanish and
// are undefined: where a rule relies on what another one promised.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "ir/text.h"
#include "passes/extend/forms.h"
#include "passes/pass.h"
#include "passes/power.h"
#include "passes/precision.h"
#include "tests/support/boxes.h"
#include "tests/support/composer.h"
#include "tests/support/effort.h"
#include "tests/support/evaluate.h"
#include "tests/support/every_form.h"
#include "tests/support/exact.h"
#include "tests/support/formula.h"

namespace imp::test {
namespace {

struct Checked {
  Program f;
  std::unique_ptr<Kernel> values;         // f, then every node on the way
  std::unique_ptr<Kernel> enclosures[2];  // float, double; null where the form has no rule
};

Program with_every_node(Program program) {
  for (std::uint32_t i = 0; i < program.graph.size(); ++i)
    if (program.graph[Id{i}].type.is_real()) program.outputs.push_back({fmt::format("node{}", i), Id{i}});
  return program;
}

Checked compose(Form& form, const Formula& formula) {
  Checked result;
  result.f = program_of(formula);
  result.values = interpret(with_every_node(reduce_powers(in_precision(result.f, f64))));
  Diagnostics diagnostics;
  for (const Type type : {f32, f64})
    if (auto enclosure = extension(result.f, form, type, diagnostics))
      result.enclosures[type == f64] = interpret(run_passes(*std::move(enclosure), kernel_passes()));
  return result;
}

// A value that overflows is no real number: nothing is said of it.
void expect_enclosed(const Checked& checked, Box1 x, Box1 y, double px, double py) {
  const auto doubles = evaluate(*checked.values, std::array{px, py});
  if (std::ranges::any_of(doubles, [](double v) { return std::isinf(v); })) return;
  const Enclosure value = exact_values(checked.f, std::array{px, py})[0];
  for (const auto& enclosure : checked.enclosures) {
    if (!enclosure) continue;
    const auto v = evaluate(*enclosure, std::array{x.lo, x.hi, y.lo, y.hi});
    const auto where = [&] {
      return fmt::format("[{}, {}] x [{}, {}] at {}, {}: {} in [{}, {}], defined {}\n{}", x.lo, x.hi, y.lo,
                         y.hi, px, py, value.nearest, v[0], v[1], v[2], to_text(checked.f));
    };
    if (value.lo > value.hi) {
      ASSERT_EQ(v[2], 0) << where();
    } else {
      ASSERT_TRUE(v[0] <= value.hi && value.lo <= v[1]) << where();
    }
  }
}

class Composition : public testing::TestWithParam<Inclusion> {
 protected:
  static Checked compose(const Formula& formula) { return test::compose(*GetParam().enclose, formula); }
  // Where it may, the test ends here.
  static bool refuses(const Checked& checked) { return may_refuse(GetParam(), checked.f); }
  void expect_random_formulas_enclosed(std::uint64_t count, bool elementary);
};

void Composition::expect_random_formulas_enclosed(std::uint64_t count, bool elementary) {
  std::size_t bounded = 0, refused = 0;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    const Checked checked =
        compose([&](Expr x, Expr y) { return Composer(x, y, seed, elementary).formula(4); });
    bounded += checked.enclosures[0] != nullptr;
    refused += refuses(checked);
    ASSERT_TRUE(refuses(checked) || checked.enclosures[0]) << "seed " << seed << '\n' << to_text(checked.f);
    Boxes boxes(seed);
    for (int i = 0; i < 12; ++i) {
      const Box1 x = boxes.box(), y = boxes.box();
      for (int k = 0; k < 3; ++k) expect_enclosed(checked, x, y, boxes.inside(x), boxes.inside(y));
      if (testing::Test::HasFatalFailure()) FAIL() << "seed " << seed;
    }
  }
  EXPECT_EQ(bounded + refused, count);
  EXPECT_GT(bounded, refused == 0 ? count / 4 : count / 50);  // few random formulas are polynomials
}

TEST_P(Composition, random_formulas_are_enclosed) { expect_random_formulas_enclosed(effort(1000), false); }
TEST_P(Composition, random_formulas_with_elementary_functions_are_enclosed) {
  expect_random_formulas_enclosed(effort(500), true);
}

Expr number_like(Expr x, double value) { return constant_like(x, value); }

// What was wrong once.
TEST_P(Composition, an_undefined_factor_makes_the_product_undefined) {
  for (const auto& formula : {Formula([](Expr x, Expr) { return (x + 2.0) * (1.0 + 0.0 * sqrt(x)); }),
                              Formula([](Expr x, Expr) { return (x + 2.0) / (1.0 + 0.0 * sqrt(x)); })}) {
    const Checked checked = compose(formula);
    if (refuses(checked)) GTEST_SKIP() << "no polynomial";
    const auto v = evaluate(*checked.enclosures[0], std::array{-3.0, -1.0, 0.0, 0.0});
    EXPECT_EQ(v[2], 0);
    EXPECT_GT(v[0], v[1]);  // empty
  }
}

TEST_P(Composition, a_quotient_may_overflow) {
  const Checked checked = compose([](Expr x, Expr y) {
    const auto sign = [](Expr a) { return make(Op::sign, a); };
    return max(sign(y) * (sign(x) / number_like(x, 3 * 0x1p-140)), number_like(x, 5));
  });
  expect_enclosed(checked, {-1, 1}, {-1, 0}, -1, -1);
}

TEST_P(Composition, max_of_an_undefined_value_is_the_other_one) {
  const Checked checked = compose([](Expr x, Expr y) { return max(sqrt(x), y); });
  expect_enclosed(checked, {-2, -1}, {1, 3}, -1, 2);
  expect_enclosed(checked, {-1, 4}, {-3, -2}, -1, -2.5);
}

INSTANTIATE_TEST_SUITE_P(Forms, Composition, every_form(), form_name);

}  // namespace
}  // namespace imp::test
