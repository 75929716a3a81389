// Intervals of elementary functions: every value lies in them, they are hardly wider than the values
// are, and they know where a function is defined and continuous.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "ir/infinity.h"
#include "ir/meaning.h"
#include "passes/elementary/lower.h"
#include "passes/extend/forms.h"
#include "tests/passes/extend/bounds.h"
#include "tests/support/formula.h"

namespace imp::test {
namespace {

struct Range1 {
  double lo = -infinity, hi = infinity;
};

struct Function {
  Op op;
  Range1 domain;
  Range1 usual{-20, 20};  // where most boxes are to lie
  bool open = false;      // not defined at the ends of its domain
};

const Function functions[] = {
    {Op::exp, {}, {-100, 100}},
    {Op::log, {0, infinity}, {-0.5, 3}, true},
    {Op::cbrt, {}},
    {Op::sin, {}},
    {Op::cos, {}},
    {Op::tan, {}},
    {Op::asin, {-1, 1}, {-1.2, 1.2}},
    {Op::acos, {-1, 1}, {-1.2, 1.2}},
    {Op::atan, {}},
    {Op::sinh, {}, {-95, 95}},
    {Op::cosh, {}, {-95, 95}},
    {Op::tanh, {}, {-8, 8}},
    {Op::asinh, {}},
    {Op::acosh, {1, infinity}, {0.5, 5}},
    {Op::atanh, {-1, 1}, {-1.2, 1.2}, true},
    {Op::pow, {0, infinity}, {-0.5, 4}},
    {Op::atan2, {}, {-2, 2}},
};

Formula formula_of(Op op) {
  return [op](Expr x, Expr y) { return info(op).arity == 1 ? make(op, x) : make(op, x, y); };
}

class ElementaryRule : public testing::TestWithParam<std::tuple<Function, Type>> {
 protected:
  ElementaryRule() {
    Diagnostics diagnostics;
    auto extended = extension(program_of(formula_of(function.op)), interval_form, type, diagnostics);
    EXPECT_TRUE(extended) << to_text(diagnostics);
    extension_ = interpret(lower_elementary(*extended));
  }

  Bounds over(Box1 x, Box1 y) const { return bounds_over(*extension_, x, y); }
  // Of real numbers, which know one zero.
  double at(double x, double y) const { return meaning::real<double>(function.op, x + 0.0, y + 0.0, 0); }

  const Function& function = std::get<0>(GetParam());
  const Type type = std::get<1>(GetParam());

 private:
  std::unique_ptr<Kernel> extension_;
};

TEST_P(ElementaryRule, encloses_every_value) {
  Boxes boxes(0xe1e);
  for (int i = 0; i < 4000; ++i) {
    const auto box = [&] {
      return boxes.pick(3) == 0 ? boxes.box() : boxes.within(function.usual.lo, function.usual.hi);
    };
    const Box1 x = box(), y = box();
    const Bounds bounds = over(x, y);
    for (int k = 0; k < 8; ++k) {
      const double px = boxes.inside(x), py = boxes.inside(y), value = at(px, py);
      if (std::isnan(value)) {
        ASSERT_FALSE(bounds.defined) << to_text(x) << to_text(y) << " at " << px << ' ' << py;
      } else if (std::isinf(value)) {  // overflow, or a pole: not a real number
        ASSERT_TRUE(bounds.lo <= value || bounds.hi >= value);
      } else {
        ASSERT_TRUE(bounds.lo <= value && value <= bounds.hi)
            << to_text(x) << to_text(y)
            << fmt::format(" at {}, {} is {}, not in [{}, {}]", px, py, value, bounds.lo, bounds.hi);
      }
    }
  }
}

// Against the values at 400 places: their hull is almost the range.
TEST_P(ElementaryRule, is_tight) {
  Boxes boxes(0x719);
  for (int i = 0; i < 300; ++i) {
    const Box1 x = boxes.within(function.usual.lo, function.usual.hi);
    const Box1 y = boxes.within(function.usual.lo, function.usual.hi);
    const Bounds bounds = over(x, y);
    if (!bounds.defined) continue;
    double lo = infinity, hi = -infinity;
    for (int k = 0; k <= 20; ++k)
      for (int m = 0; m <= 20; ++m) {
        const bool flat = info(function.op).arity == 1;
        const double t = flat ? (21 * k + m) / 440.0 : k / 20.0, s = m / 20.0;
        const double value = at(std::lerp(x.lo, x.hi, t), std::lerp(y.lo, y.hi, s));
        lo = std::min(lo, value);
        hi = std::max(hi, value);
      }
    if (!(std::abs(lo) < 1e30) || !(std::abs(hi) < 1e30)) continue;  // overflows in float
    const double eps = type == f32 ? 1e-6 : 1e-14;
    const double slack = 0.01 * (hi - lo) + eps * (1 + std::max(std::abs(lo), std::abs(hi)));
    const double input_slack =
        type == f32 ? (hi - lo) * 1e-3 + eps * 100 * std::max(std::abs(lo), std::abs(hi)) : 0;
    EXPECT_GE(bounds.lo, lo - slack - input_slack) << to_text(x) << to_text(y);
    EXPECT_LE(bounds.hi, hi + slack + input_slack) << to_text(x) << to_text(y);
  }
}

TEST_P(ElementaryRule, knows_where_it_is_defined) {
  if (info(function.op).arity == 2 || function.op == Op::tan) return;
  const auto [lo, hi] = function.domain;
  const double below = lo - 0.5, inside = std::max(lo, -0.75) + 0.25, above = hi + 0.5;
  EXPECT_TRUE(over({inside, inside + 0.25}, {}).defined);
  if (lo > -infinity) {
    EXPECT_EQ(over({lo, inside}, {}).defined, !function.open);
    EXPECT_FALSE(over({below, inside}, {}).defined);
    const Bounds outside = over({below - 1, below}, {});
    EXPECT_TRUE(outside.lo > outside.hi && !outside.defined);
  }
  if (hi < infinity) {
    EXPECT_EQ(over({inside, hi}, {}).defined, !function.open);
    EXPECT_FALSE(over({inside, above}, {}).defined);
    const Bounds outside = over({above, above + 1}, {});
    EXPECT_TRUE(outside.lo > outside.hi && !outside.defined);
  }
}

std::string function_name(const testing::TestParamInfo<std::tuple<Function, Type>>& test) {
  const auto& [function, type] = test.param;
  return std::string(info(function.op).name) + (type == f32 ? "_f32" : "_f64");
}

INSTANTIATE_TEST_SUITE_P(functions, ElementaryRule,
                         testing::Combine(testing::ValuesIn(functions), testing::Values(f32, f64)),
                         function_name);

Bounds over(Op op, Type type, Box1 x, Box1 y = {}) {
  Diagnostics diagnostics;
  const auto extended = extension(program_of(formula_of(op)), interval_form, type, diagnostics);
  return bounds_over(*interpret(lower_elementary(*extended)), x, y);
}

struct SpecialCase {
  Op op;
  Box1 x, y;
  double lo, hi;  // to five digits
  bool defined;
};

constexpr double pi = std::numbers::pi;

// Poles, cuts, infinite operands, and angles beyond what is reduced.
const SpecialCase special_cases[] = {
    {Op::tan, {1, 2}, {}, -infinity, infinity, false},
    {Op::tan, {-1, 1}, {}, -1.55741, 1.55741, true},
    {Op::tan, {2, 4}, {}, -2.18504, 1.15782, true},
    {Op::sin, {0, infinity}, {}, -1, 1, true},
    {Op::sin, {2e9, 2e9}, {}, -1, 1, true},
    {Op::tan, {2e9, 2e9}, {}, -infinity, infinity, false},
    {Op::sin, {1, 2}, {}, 0.841471, 1, true},
    {Op::sin, {4, 5}, {}, -1, -0.756802, true},
    {Op::cos, {-1, 1}, {}, 0.540302, 1, true},
    {Op::cos, {3, 4}, {}, -1, -0.653644, true},
    {Op::cos, {1, 2}, {}, -0.416147, 0.540302, true},
    {Op::exp, {-infinity, 0}, {}, 0, 1, true},
    {Op::exp, {-2000, -1000}, {}, 0, 0, true},
    {Op::log, {0, 1}, {}, -infinity, 0, false},
    {Op::log, {1, infinity}, {}, 0, infinity, true},
    {Op::atanh, {-1, 0}, {}, -infinity, 0, false},
    {Op::acosh, {1, 2}, {}, 0, 1.31696, true},
    {Op::tanh, {-infinity, infinity}, {}, -1, 1, true},
    {Op::cosh, {-1, 2}, {}, 1, 3.7622, true},
    {Op::atan, {-infinity, infinity}, {}, -pi / 2, pi / 2, true},
    {Op::atan2, {1, 2}, {-1, 1}, pi / 4, 3 * pi / 4, true},
    {Op::atan2, {-1, 1}, {1, 2}, -pi / 4, pi / 4, true},
    {Op::atan2, {-1, 1}, {-2, -1}, -pi, pi, false},
    {Op::atan2, {0, 1}, {-2, -1}, 3 * pi / 4, pi, true},
    {Op::atan2, {0, 0}, {-2, -1}, pi, pi, true},
    {Op::atan2, {-0.0, 0.0}, {-2, -1}, pi, pi, true},
    {Op::atan2, {-2, -1}, {-1, 1}, -3 * pi / 4, -pi / 4, true},
    {Op::atan2, {0, 0}, {0, 0}, 0, pi, false},
    {Op::atan2, {0, 1}, {0, 1}, 0, pi, false},
    {Op::pow, {0, 4}, {0.5, 0.5}, 0, 2, true},
    {Op::pow, {0, 4}, {-0.5, -0.5}, 0.5, infinity, false},
    {Op::pow, {0.5, 2}, {-1, 2}, 0.25, 4, true},
    {Op::pow, {-2, 4}, {1.5, 1.5}, 0, 8, false},
    {Op::pow, {0, 0}, {0, 1}, 0, 1, false},
    {Op::pow, {1, infinity}, {-1, 1}, 0, infinity, true},
};

TEST(ElementaryRules, exceptions) {
  for (const Type type : {f32, f64})
    for (const SpecialCase& c : special_cases) {
      const Bounds got = over(c.op, type, c.x, c.y);
      const auto near = [](double a, double b) {
        return a == b || std::abs(a - b) <= 2e-5 * std::max(1.0, std::abs(b));
      };
      EXPECT_TRUE(near(got.lo, c.lo) && near(got.hi, c.hi) && got.defined == c.defined)
          << info(c.op).name << to_text(c.x) << to_text(c.y) << " is " << to_text(Box1{got.lo, got.hi}) << ' '
          << got.defined;
    }
}

TEST(ElementaryRules, what_overflows_lies_between_the_largest_number_and_infinity) {
  for (const Op op : {Op::exp, Op::cosh, Op::sinh}) {
    EXPECT_EQ(over(op, f32, {1000, 2000}).lo, std::numeric_limits<float>::max());
    EXPECT_EQ(over(op, f64, {1000, 2000}).lo, std::numeric_limits<double>::max());
    EXPECT_EQ(over(op, f32, {1000, 2000}).hi, infinity);
  }
  EXPECT_GE(over(Op::sinh, f32, {-2000, -1000}).hi, -std::numeric_limits<float>::max());
}

TEST(ElementaryRules, ranges_fold) {
  Program f{.name = "f"};
  const Expr x = input(f, "x", f64), y = input(f, "y", f64);
  for (const Function& function : functions)
    output(f, std::string(info(function.op).name), formula_of(function.op)(x, y));
  const imp::Range box[] = {{0.25, 0.5}, {0.5, 2}};
  const auto known = ranges(f, box, f32);
  for (const Output& o : f.outputs) {
    ASSERT_TRUE(known[o.id.index]) << o.name;
    if (o.name == "sin") {
      EXPECT_NEAR(known[o.id.index]->hi, std::sin(0.5), 1e-6);
    } else if (o.name == "pow") {
      EXPECT_NEAR(known[o.id.index]->lo, 0.0625, 1e-6);
    }
  }
}

}  // namespace
}  // namespace imp::test
