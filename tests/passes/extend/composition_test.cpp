// Enclosures of formulas put together at random, with constants that overflow, underflow, vanish and
// are undefined: where a rule relies on what another one promised.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "ir/text.h"
#include "passes/extend/interval.h"
#include "passes/power.h"
#include "passes/precision.h"
#include "tests/support/boxes.h"
#include "tests/support/evaluate.h"
#include "tests/support/make.h"

namespace imp::test {
namespace {

class Composer {
 public:
  Composer(Expr x, Expr y, std::uint64_t seed, bool elementary = false)
      : x_(x), y_(y), random_(seed), elementary_(elementary) {}

  Expr formula(int depth) {
    if (depth == 0) return leaf();
    const auto part = [&] { return formula(depth - 1 - static_cast<int>(random_.below(2)) % depth); };
    const Expr a = part(), b = part();
    switch (random_.below(elementary_ ? 24 : 16)) {
      case 0:
      case 1:  return a + b;
      case 2:  return a - b;
      case 3:
      case 4:
      case 5:  return a * b;
      case 6:
      case 7:  return a / b;
      case 8:  return min(a, b);
      case 9:  return max(a, b);
      case 10: return sqrt(a);
      case 11: return abs(a);
      case 12: return make(Op::powi, a, constant_like(a, static_cast<double>(random_.below(6)) - 2));
      case 13: return make(Op::sign, a);
      case 14: return select(a < b, a, b * 2.0);
      case 15: return floor(a);
      case 16: return make(Op::exp, a);
      case 17: return make(Op::log, a);
      case 18: return make(Op::sin, a);
      case 19: return make(Op::tan, a);
      case 20: return make(Op::acos, a);
      case 21: return make(Op::atanh, a);
      case 22: return make(Op::pow, a, b);
      default: return ceil(a);
    }
  }

 private:
  Expr leaf() {
    static constexpr double constants[] = {
        0, 1, 2, -3, 0.1, 5, 3 * 0x1p-140, 1e-30, 1e30, 3 * 0x1p-1070, 1e300, -1e-40};
    switch (random_.below(3)) {
      case 0:  return x_;
      case 1:  return y_;
      default: return constant_like(x_, constants[random_.below(std::size(constants))]);
    }
  }

  Expr x_, y_;
  Random random_;
  bool elementary_;
};

struct Checked {
  Program f;
  std::unique_ptr<Kernel> values;         // f, then every node on the way
  std::unique_ptr<Kernel> enclosures[2];  // float, double
};

Program with_every_node(Program program) {
  for (std::uint32_t i = 0; i < program.graph.size(); ++i)
    if (program.graph[Id{i}].type.is_real()) program.outputs.push_back({fmt::format("node{}", i), Id{i}});
  return program;
}

Checked compose(const std::function<Expr(Expr, Expr)>& formula) {
  Checked result;
  result.f.name = "f";
  const Expr x = input(result.f, "x", f64), y = input(result.f, "y", f64);
  output(result.f, "f", formula(x, y));
  result.values = interpret(with_every_node(reduce_powers(in_precision(result.f, f64))));
  Diagnostics diagnostics;
  for (const Type type : {f32, f64})
    result.enclosures[type == f64] = interpret(*interval_extension(result.f, type, diagnostics));
  return result;
}

// Every op rounds to nearest, and outward the bounds that are doubles: so a value computed in doubles
// lies between them to the last bit.
void expect_enclosed(const Checked& checked, Box1 x, Box1 y, double px, double py) {
  const auto values = evaluate(*checked.values, std::array{px, py});
  if (std::ranges::any_of(values, [](double v) { return std::isinf(v); })) return;  // no real number
  for (const auto& enclosure : checked.enclosures) {
    const auto v = evaluate(*enclosure, std::array{x.lo, x.hi, y.lo, y.hi});
    const auto where = [&] {
      return fmt::format("[{}, {}] x [{}, {}] at {}, {}: {} in [{}, {}], defined {}\n{}", x.lo, x.hi, y.lo,
                         y.hi, px, py, values[0], v[0], v[1], v[2], to_text(checked.f));
    };
    if (std::isnan(values[0])) {
      ASSERT_EQ(v[2], 0) << where();
    } else {
      ASSERT_TRUE(v[0] <= values[0] && values[0] <= v[1]) << where();
    }
  }
}

void expect_random_formulas_enclosed(std::uint64_t count, bool elementary) {
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    const Checked checked =
        compose([&](Expr x, Expr y) { return Composer(x, y, seed, elementary).formula(4); });
    Boxes boxes(seed);
    for (int i = 0; i < 12; ++i) {
      const Box1 x = boxes.box(), y = boxes.box();
      for (int k = 0; k < 3; ++k) expect_enclosed(checked, x, y, boxes.inside(x), boxes.inside(y));
      if (testing::Test::HasFatalFailure()) FAIL() << "seed " << seed;
    }
  }
}

TEST(Composition, random_formulas_are_enclosed) { expect_random_formulas_enclosed(6000, false); }
TEST(Composition, random_formulas_with_elementary_functions_are_enclosed) {
  expect_random_formulas_enclosed(4000, true);
}

Expr number_like(Expr x, double value) { return constant_like(x, value); }

// What was wrong once.
TEST(Composition, an_undefined_factor_makes_the_product_undefined) {
  for (const auto& formula :
       {std::function([](Expr x, Expr) { return (x + 2.0) * (1.0 + 0.0 * sqrt(x)); }),
        std::function([](Expr x, Expr) { return (x + 2.0) / (1.0 + 0.0 * sqrt(x)); })}) {
    const auto v = evaluate(*compose(formula).enclosures[0], std::array{-3.0, -1.0, 0.0, 0.0});
    EXPECT_EQ(v[2], 0);
    EXPECT_GT(v[0], v[1]);  // empty
  }
}

TEST(Composition, a_quotient_may_overflow) {
  const Checked checked = compose([](Expr x, Expr y) {
    const auto sign = [](Expr a) { return make(Op::sign, a); };
    return max(sign(y) * (sign(x) / number_like(x, 3 * 0x1p-140)), number_like(x, 5));
  });
  expect_enclosed(checked, {-1, 1}, {-1, 0}, -1, -1);
}

TEST(Composition, max_of_an_undefined_value_is_the_other_one) {
  const Checked checked = compose([](Expr x, Expr y) { return max(sqrt(x), y); });
  expect_enclosed(checked, {-2, -1}, {1, 3}, -1, 2);
  expect_enclosed(checked, {-1, 4}, {-3, -2}, -1, -2.5);
}

}  // namespace
}  // namespace imp::test
