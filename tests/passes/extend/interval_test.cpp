// Intervals enclose: every rule on random boxes with values at their ends, and what sets IEEE 1788
// asks for at the exceptions.
#include "ir/infinity.h"
#include "passes/extend/forms.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "ir/text.h"
#include "ir/verify.h"
#include "passes/power.h"
#include "passes/precision.h"
#include "tests/passes/extend/bounds.h"
#include "tests/support/formula.h"

namespace imp::test {
namespace {

// A formula of x and y with its extension, ready to run.
class Extended {
 public:
  Extended(const Formula& formula, Type type) {
    const Program f = program_of(formula);
    point_ = interpret(reduce_powers(in_precision(f, f64)));
    Diagnostics diagnostics;
    auto extended = extension(f, interval_form, type, diagnostics);
    EXPECT_TRUE(extended) << to_text(diagnostics);
    EXPECT_EQ(verify(*extended), "");
    text_ = to_text(*extended);
    extension_ = interpret(*std::move(extended));
  }

  double at(double x, double y) const { return evaluate(*point_, std::array{x, y})[0]; }
  Bounds over(Box1 x, Box1 y) const { return bounds_over(*extension_, x, y); }
  const std::string& text() const { return text_; }

 private:
  std::unique_ptr<Kernel> point_, extension_;
  std::string text_;
};

// Each op on its own, so that one rounding in double is all that stands between the value and the
// exact one: rounding to nearest never carries it over a bound that is a double.
const NamedFormula single_ops[] = {
    {"add", [](Expr x, Expr y) { return x + y; }},
    {"sub", [](Expr x, Expr y) { return x - y; }},
    {"mul", [](Expr x, Expr y) { return x * y; }},
    {"square", [](Expr x, Expr) { return x * x; }},
    {"div", [](Expr x, Expr y) { return x / y; }},
    {"reciprocal", [](Expr, Expr y) { return 1.0 / y; }},
    {"neg", [](Expr x, Expr) { return -x; }},
    {"abs", [](Expr x, Expr) { return abs(x); }},
    {"min", [](Expr x, Expr y) { return min(x, y); }},
    {"max", [](Expr x, Expr y) { return max(x, y); }},
    {"sqrt", [](Expr x, Expr) { return sqrt(x); }},
    {"floor", [](Expr x, Expr) { return floor(x); }},
    {"ceil", [](Expr x, Expr) { return ceil(x); }},
    {"sign", [](Expr x, Expr) { return make(Op::sign, x); }},
    {"times 3", [](Expr x, Expr) { return 3.0 * x; }},
    {"times -3", [](Expr x, Expr) { return x * -3.0; }},
    {"times 0", [](Expr x, Expr) { return x * 0.0; }},
    {"over 3", [](Expr x, Expr) { return x / 3.0; }},
    {"over -3", [](Expr x, Expr) { return x / -3.0; }},
    {"select", [](Expr x, Expr y) { return select(x < y, x, y); }},
    {"select le", [](Expr x, Expr y) { return select(!(x <= y) || x < 0, x, y); }},
    {"select and", [](Expr x, Expr y) { return select(x < y && 0 < x, x * y, 3.0 - x); }},
    {"select not and", [](Expr x, Expr y) { return select(!(y < 1 && x <= y), y, -x); }},
    {"select eq", [](Expr x, Expr y) { return select(equal(x, y), x, -y); }},
    {"select sqrt", [](Expr x, Expr y) { return select(sqrt(x) < 1, x, y); }},
    {"product of squares", [](Expr x, Expr y) { return (abs(x)) * (abs(y)); }},
    {"abs times", [](Expr x, Expr y) { return abs(x) * y; }},
    {"negative times", [](Expr x, Expr y) { return y * -abs(x); }},
    {"x over abs", [](Expr x, Expr y) { return x / abs(y); }},
};

class EveryRule : public testing::TestWithParam<Type> {};

TEST_P(EveryRule, encloses_every_value) {
  for (const NamedFormula& formula : single_ops) {
    const Extended f(formula.build, GetParam());
    Boxes boxes(0x1e55);
    for (int i = 0; i < 1500; ++i) {
      const Box1 x = boxes.box(), y = boxes.pick(8) == 0 ? x : boxes.box();
      const Bounds bounds = f.over(x, y);
      for (int k = 0; k < 6; ++k) {
        const double px = boxes.inside(x), py = boxes.inside(y);
        const double value = f.at(px, py);
        if (std::isnan(value)) {
          EXPECT_FALSE(bounds.defined) << formula.name << " at " << px << ' ' << py;
        } else if (std::isinf(value)) {  // overflow, or a pole: not a real number
          EXPECT_TRUE(bounds.lo <= value || bounds.hi >= value);
        } else {
          ASSERT_TRUE(bounds.lo <= value && value <= bounds.hi)
              << formula.name
              << fmt::format(" of [{}, {}], [{}, {}] at {}, {} is {}, not in [{}, {}]\n", x.lo, x.hi, y.lo,
                             y.hi, px, py, value, bounds.lo, bounds.hi)
              << f.text();
        }
      }
    }
  }
}

// The bounds of a power hold its exact value; long double, whose own error is far below a double's
// last place for these exponents, stands in for it.
TEST_P(EveryRule, encloses_powers) {
  for (const double n : {0, 1, 2, 3, 4, 5, 7, 8, 16, 17, 33, 500, -1, -2, -3, -16}) {
    const Extended f([n](Expr x, Expr) { return power(x, n); }, GetParam());
    Boxes boxes(0x9017);
    for (int i = 0; i < 1500; ++i) {
      const Box1 x = boxes.pick(2) ? boxes.box() : boxes.within(-1.3, 1.3);
      const Bounds bounds = f.over(x, {0, 0});
      const double at = boxes.inside(x);
      const long double value = std::pow(static_cast<long double>(at), static_cast<long double>(n));
      if (std::isinf(value)) continue;
      ASSERT_TRUE(bounds.lo <= value && value <= bounds.hi)
          << fmt::format("{}^{} on [{}, {}] is {}, not in [{}, {}]", at, n, x.lo, x.hi,
                         static_cast<double>(value), bounds.lo, bounds.hi);
    }
  }
}

TEST_P(EveryRule, is_tight_for_even_and_odd_powers) {
  const auto over = [&](double n, Box1 x) {
    return Extended([n](Expr a, Expr) { return power(a, n); }, GetParam()).over(x, {0, 0});
  };
  EXPECT_EQ(over(2, {-1, 2}).lo, 0);
  EXPECT_EQ(over(2, {-1, 2}).hi, 4);
  EXPECT_EQ(over(3, {-1, 2}).lo, -1);
  EXPECT_EQ(over(3, {-1, 2}).hi, 8);
  EXPECT_EQ(over(6, {-2, 1}).hi, 64);
  EXPECT_EQ(over(-1, {1, 2}).lo, 0.5);
  EXPECT_EQ(over(0, {-1, 2}).lo, 1);
}

INSTANTIATE_TEST_SUITE_P(precision, EveryRule, testing::Values(f32, f64),
                         [](const auto& test) { return to_text(test.param); });

struct Exception {
  const char* name;
  Formula build;
  Box1 x, y;
  Bounds expected;
};

const Exception exceptions[] = {
    {"1/[0,0] is empty", [](Expr, Expr y) { return 1.0 / y; }, {0, 0}, {0, 0}, {infinity, -infinity, false}},
    {"1/[0,2]", [](Expr, Expr y) { return 1.0 / y; }, {0, 0}, {0, 2}, {0.5, infinity, false}},
    {"1/[-0,2]", [](Expr, Expr y) { return 1.0 / y; }, {0, 0}, {-0.0, 2}, {0.5, infinity, false}},
    {"1/[-2,0]", [](Expr, Expr y) { return 1.0 / y; }, {0, 0}, {-2, 0}, {-infinity, -0.5, false}},
    {"1/[-1,1]", [](Expr, Expr y) { return 1.0 / y; }, {0, 0}, {-1, 1}, {-infinity, infinity, false}},
    {"[0,0]/[-1,1]", [](Expr x, Expr y) { return x / y; }, {0, 0}, {-1, 1}, {0, 0, false}},
    {"[1,2]/[2,4]", [](Expr x, Expr y) { return x / y; }, {1, 2}, {2, 4}, {0.25, 1, true}},
    {"[1,2]/[2,inf]", [](Expr x, Expr y) { return x / y; }, {1, 2}, {2, infinity}, {0, 1, true}},
    {"sqrt([-1,4])", [](Expr x, Expr) { return sqrt(x); }, {-1, 4}, {0, 0}, {0, 2, false}},
    {"sqrt([-2,-1])", [](Expr x, Expr) { return sqrt(x); }, {-2, -1}, {0, 0}, {infinity, -infinity, false}},
    {"sqrt([0,inf])", [](Expr x, Expr) { return sqrt(x); }, {0, infinity}, {0, 0}, {0, infinity, true}},
    {"sqrt of empty + y",
     [](Expr x, Expr y) { return sqrt(x) + y; },
     {-2, -1},
     {-infinity, infinity},
     {infinity, -infinity, false}},
    {"0 * entire", [](Expr x, Expr y) { return x * y; }, {0, 0}, {-infinity, infinity}, {0, 0, true}},
    {"[0,1] * [2,inf]", [](Expr x, Expr y) { return x * y; }, {0, 1}, {2, infinity}, {0, infinity, true}},
    {"[-1,0] * [-inf,3]",
     [](Expr x, Expr y) { return x * y; },
     {-1, 0},
     {-infinity, 3},
     {-3, infinity, true}},
    {"entire - entire",
     [](Expr x, Expr y) { return x - y; },
     {-infinity, infinity},
     {-infinity, infinity},
     {-infinity, infinity, true}},
    {"lo > hi is no box", [](Expr x, Expr) { return x; }, {2, 1}, {0, 0}, {infinity, -infinity, false}},
    {"NaN is no box", [](Expr x, Expr) { return x; }, {NAN, 1}, {0, 0}, {infinity, -infinity, false}},
    {"floor within", [](Expr x, Expr) { return floor(x); }, {1.25, 1.5}, {0, 0}, {1, 1, true}},
    {"floor across", [](Expr x, Expr) { return floor(x); }, {0.5, 1.5}, {0, 0}, {0, 1, false}},
    {"if decided", [](Expr x, Expr y) { return select(x < 0, sqrt(x), y); }, {1, 2}, {3, 4}, {3, 4, true}},
    {"if and decided",
     [](Expr x, Expr y) { return select(x < 0 && y < 9, sqrt(x), y); },
     {1, 2},
     {3, 4},
     {3, 4, true}},
    {"if or decided",
     [](Expr x, Expr y) { return select(9 < y || 0 < x, y, sqrt(-x)); },
     {1, 2},
     {3, 4},
     {3, 4, true}},
    {"if open", [](Expr x, Expr y) { return select(x < 0, -x, y); }, {-1, 2}, {3, 4}, {-2, 4, false}},
};

bool is_near(double a, double b) { return a == b || std::abs(a - b) < 1e-6; }

TEST(Interval, exceptions_are_as_ieee_1788_has_them) {
  for (const Type type : {f32, f64})
    for (const Exception& e : exceptions) {
      const Bounds got = Extended(e.build, type).over(e.x, e.y);
      EXPECT_TRUE(is_near(got.lo, e.expected.lo)) << e.name << ' ' << got.lo;
      EXPECT_TRUE(is_near(got.hi, e.expected.hi)) << e.name << ' ' << got.hi;
      EXPECT_EQ(got.defined, e.expected.defined) << e.name;
    }
}

// What is no float is enclosed: the answer is for exactly these doubles and these constants.
TEST(Interval, constants_and_inputs_that_are_no_floats_are_enclosed) {
  const Extended tenth([](Expr x, Expr) { return x - x / 1.0 + make(Op::div, one(x), constant_like(x, 10)); },
                       f32);
  const Bounds at_zero = tenth.over({0, 0}, {0, 0});
  EXPECT_LT(at_zero.lo, 0.1);
  EXPECT_GT(at_zero.hi, 0.1);
  EXPECT_LT(at_zero.hi - at_zero.lo, 1e-7);
  const Bounds input_tenth = Extended([](Expr x, Expr) { return x; }, f32).over({0.1, 0.1}, {0, 0});
  EXPECT_LT(input_tenth.lo, 0.1);
  EXPECT_GT(input_tenth.hi, 0.1);
}

// Two different values with the same bounds are no square.
TEST(Interval, equal_bounds_are_not_equal_values) {
  const Bounds product = Extended([](Expr x, Expr y) { return x * y; }, f64).over({-1, 1}, {-1, 1});
  EXPECT_EQ(product.lo, -1);
}

TEST(Interval, an_op_without_a_rule_is_refused_at_its_place) {
  Program f{.name = "f"};
  const Expr x = input(f, "x", f64);
  output(f, "f", make(Op::scale2, x, x));
  Diagnostics diagnostics;
  EXPECT_FALSE(extension(f, interval_form, f32, diagnostics));
  ASSERT_EQ(diagnostics.errors(), 1u);
  EXPECT_EQ(diagnostics.all()[0].message, "the interval extension cannot bound 'scale2' yet");
}

TEST(Range, folds_to_what_a_node_can_be) {
  Program f{.name = "f"};
  const Expr x = input(f, "x", f64), y = input(f, "y", f64);
  output(f, "f", x * x + y);
  const Range box[] = {{-1, 2}, {0, 3}};
  const auto known = ranges(f, box);
  const auto of_f = known[f.outputs[0].id.index];
  ASSERT_TRUE(of_f);
  EXPECT_EQ(of_f->lo, 0);
  EXPECT_EQ(of_f->hi, 7);
}

}  // namespace
}  // namespace imp::test
