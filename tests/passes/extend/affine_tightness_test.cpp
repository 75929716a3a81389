// What affine forms are for: where operands depend on each other they are narrower than intervals, rule by rule.
#include <gtest/gtest.h>

#include <cmath>

#include "ir/infinity.h"
#include "passes/extend/forms.h"
#include "passes/pass.h"
#include "tests/passes/extend/bounds.h"
#include "tests/support/formula.h"

namespace imp::test {
namespace {

Bounds over(const Formula& formula, Form& form, Type type, Box1 x, Box1 y) {
  Diagnostics diagnostics;
  const auto enclosure = extension(program_of(formula), form, type, diagnostics);
  return bounds_over(*interpret(run_passes(*enclosure, kernel_passes())), x, y);
}

struct Tied {
  const char* name;
  Formula formula;
  Box1 x, y;
  double factor;  // of the width by intervals, what the affine form must stay below
};
void PrintTo(const Tied& tied, std::ostream* out) { *out << tied.name; }

#define IMP_OF(expression) [](Expr x, Expr y) { return (void)y, expression; }
constexpr Box1 unit{-1, 1}, near_zero{-0.2, 0.2}, near_one{0.9, 1.1};
const Tied tied_formulas[] = {
    {"difference", IMP_OF(x - x), {-3, 5}, unit, 1e-28},
    {"sums", IMP_OF((x + 2.0 * y) - (x - y) - 3.0 * y), {-3, 5}, unit, 1e-6},
    {"scaled", IMP_OF(0.1 * x - x / 10.0), {1, 2}, unit, 4e-6},
    {"product", IMP_OF(x * (1.0 - x)), {0.4, 0.6}, unit, 0.06},
    {"products", IMP_OF((x - y) * (x + y) - x * x + y * y), near_one, {0.4, 0.6}, 0.08},
    {"square", IMP_OF(x* x - 2.0 * x), near_one, unit, 0.03},
    {"cube", IMP_OF(make(Op::powi, x, constant_like(x, 3)) - 3.0 * x), near_one, unit, 0.03},
    {"reciprocal", IMP_OF(1.0 / x + x), {1, 2}, unit, 0.4},
    {"of_negative", IMP_OF(1.0 / x + x), {-2, -1}, unit, 0.4},
    {"quotient", IMP_OF(x / (1.0 + x)), {1, 3}, unit, 0.4},
    {"sqrt", IMP_OF(sqrt(x) - x / 2.0), near_one, unit, 0.01},
    {"abs", IMP_OF(abs(x) - x / 2.0), {-1, 3}, unit, 0.31},
    {"max", IMP_OF(max(x + y, x - y) - x), {0, 8}, unit, 0.06},
    {"min", IMP_OF(min(x + y, x - y) - x), {0, 8}, unit, 0.06},
    {"exp", IMP_OF(make(Op::exp, x) - 1.0 - x), near_zero, unit, 0.03},
    {"log", IMP_OF(make(Op::log, x) - x), near_one, unit, 0.02},
    {"sin", IMP_OF(make(Op::sin, x) - x), near_zero, unit, 0.01},
    {"sin_of_more", IMP_OF(make(Op::sin, x) - x), {0.2, 0.4}, unit, 0.04},
    {"cos", IMP_OF(make(Op::cos, x) + x / 2.0), {0.42, 0.62}, unit, 0.03},
    {"tan", IMP_OF(make(Op::tan, x) - x), near_zero, unit, 0.03},
    {"asin", IMP_OF(make(Op::asin, x) - x), near_zero, unit, 0.03},
    {"acos", IMP_OF(make(Op::acos, x) + x), near_zero, unit, 0.03},
    {"atan", IMP_OF(make(Op::atan, x) - x), near_zero, unit, 0.03},
    {"sinh", IMP_OF(make(Op::sinh, x) - x), near_zero, unit, 0.03},
    {"tanh", IMP_OF(make(Op::tanh, x) - x), near_zero, unit, 0.03},
    {"asinh", IMP_OF(make(Op::asinh, x) - x), near_zero, unit, 0.03},
    {"atanh", IMP_OF(make(Op::atanh, x) - x), near_zero, unit, 0.03},
    {"acosh", IMP_OF(make(Op::acosh, x) - 0.577 * x), {1.9, 2.1}, unit, 0.04},
    {"cosh", IMP_OF(make(Op::cosh, x) - 1.1752 * x), near_one, unit, 0.08},
    {"cbrt", IMP_OF(make(Op::cbrt, x) - x / 3.0), near_one, unit, 0.04},
    {"pow", IMP_OF(make(Op::pow, x, constant_like(x, 1.5)) - 1.5 * x), near_one, unit, 0.03},
};

class Tightness : public testing::TestWithParam<Tied> {};

TEST_P(Tightness, forms_are_narrower_than_intervals) {
  const auto& [name, formula, x, y, factor] = GetParam();
  for (const Type type : {f32, f64}) {
    const Bounds intervals = over(formula, interval_form, type, x, y);
    for (Form* form : {&affine_form, &affine_and_interval_form, &signed_affine_form}) {
      const Bounds bounds = over(formula, *form, type, x, y);
      EXPECT_TRUE(bounds.defined);
      EXPECT_LE(bounds.lo, bounds.hi);
      EXPECT_LT(bounds.width(), factor * intervals.width()) << bounds.width() / intervals.width();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Affine, Tightness, testing::ValuesIn(tied_formulas),
                         [](const auto& test) { return test.param.name; });

// No form holds there: of infinite ends nothing may cancel.
TEST(AffineBoxes, infinite_ones_are_those_of_intervals) {
  const Formula formulas[] = {IMP_OF(x - x),      IMP_OF(x * x - x),     IMP_OF(sqrt(x) - x),
                              IMP_OF(abs(x) + x), IMP_OF(max(x, y) - x), IMP_OF(make(Op::exp, -x) + x)};
  for (const Formula& formula : formulas)
    for (const Type type : {f32, f64})
      for (const Box1 x : {Box1{-infinity, infinity}, {0, infinity}, {-infinity, 1}})
        for (Form* form : {&affine_form, &affine_and_interval_form, &signed_affine_form}) {
          const Bounds bounds = over(formula, *form, type, x, unit);
          const Bounds intervals = over(formula, interval_form, type, x, unit);
          EXPECT_EQ(bounds.lo, intervals.lo);
          EXPECT_EQ(bounds.hi, intervals.hi);
          EXPECT_EQ(bounds.defined, intervals.defined);
        }
}

TEST(AffineBoxes, empty_ones_have_no_values) {
  struct {
    Formula formula;
    Box1 x;
  } const cases[] = {{IMP_OF(x - y), {1, -1}},
                     {IMP_OF(x - y), {std::nan(""), 1}},
                     {IMP_OF(x - y), {infinity, infinity}},
                     {IMP_OF(sqrt(x) - x), {-2, -1}},
                     {IMP_OF(make(Op::log, x) * y), {-2, -1}}};
  for (const auto& [formula, x] : cases)
    for (const Type type : {f32, f64})
      for (Form* form : {&affine_form, &affine_and_interval_form, &signed_affine_form}) {
        const Bounds bounds = over(formula, *form, type, x, unit);
        EXPECT_GT(bounds.lo, bounds.hi);
        EXPECT_FALSE(bounds.defined);
      }
}

#undef IMP_OF

}  // namespace
}  // namespace imp::test
