// What is particular to the functions of angles: shared work, quarter turns, zeros and infinities.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <random>

#include "ir/infinity.h"
#include "passes/elementary/bounds.h"
#include "passes/elementary/lower.h"
#include "tests/support/arguments.h"
#include "tests/support/cost.h"
#include "tests/support/evaluate.h"
#include "tests/support/make.h"

namespace imp {
namespace {

using test::cost;
using test::input;
using test::output;

constexpr double pi = std::numbers::pi;

class AngleFunctions : public testing::TestWithParam<Type> {
 protected:
  Type type() const { return GetParam(); }

  Program lowered(std::initializer_list<Op> functions) const {
    Program p;
    const Expr x = input(p, "x", type()), y = input(p, "y", type());
    for (const Op op : functions)
      output(p, std::string(info(op).name), info(op).arity == 1 ? make(op, x) : make(op, x, y));
    return lower_elementary(p);
  }

  class Function {
   public:
    explicit Function(Program program) : kernel_(interpret(std::move(program))) {}
    double operator()(double x, double y = 0) const { return test::evaluate(*kernel_, std::array{x, y})[0]; }

   private:
    std::unique_ptr<Kernel> kernel_;
  };
  Function function(Op op) const { return Function(lowered({op})); }

  // Right but for an ulp.
  void expect_near(double got, double right) const {
    EXPECT_NEAR(got, right, std::abs(right) * (type() == f32 ? 0x1p-23 : 0x1p-52));
  }

  double rounded(double x) const { return test::rounded(x, type()); }
  double below(double x) const {
    return type() == f32 ? std::nextafter(static_cast<float>(x), 0.0f) : std::nextafter(x, 0.0);
  }
  double above(double x) const {
    return type() == f32 ? std::nextafter(static_cast<float>(x), std::numeric_limits<float>::infinity())
                         : std::nextafter(x, infinity);
  }
};

INSTANTIATE_TEST_SUITE_P(Types, AngleFunctions, testing::Values(f32, f64),
                         [](const auto& test) { return test.param == f32 ? "f32" : "f64"; });

std::size_t count(const Program& program, Op op) {
  const Program live = compact(program);
  std::size_t found = 0;
  for (std::uint32_t i = 0; i < live.graph.size(); ++i) found += live.graph[Id{i}].op == op;
  return found;
}

TEST_P(AngleFunctions, sine_and_cosine_share_all_but_their_last_steps) {
  const std::size_t both = cost(lowered({Op::sin, Op::cos}));
  EXPECT_LE(both, cost(lowered({Op::sin})) + 5);
  EXPECT_LE(both, cost(lowered({Op::cos})) + 5);
}

TEST_P(AngleFunctions, tangent_shares_the_reduction) {
  const std::size_t apart = cost(lowered({Op::tan})) + cost(lowered({Op::sin}));
  EXPECT_LE(cost(lowered({Op::tan, Op::sin})), apart - 15);
}

TEST_P(AngleFunctions, are_cheap) {
  const std::size_t more = type() == f32 ? 0 : 28;  // terms of polynomials, and a part more of pi/2
  EXPECT_LE(cost(lowered({Op::sin, Op::cos})), 50 + more);
  EXPECT_LE(cost(lowered({Op::tan})), 66 + more);
  EXPECT_LE(cost(lowered({Op::asin})), 30 + more);
  EXPECT_LE(cost(lowered({Op::acos})), 38 + more);
  EXPECT_LE(cost(lowered({Op::atan})), 34 + more);
  EXPECT_EQ(count(lowered({Op::sin, Op::cos}), Op::div), 0u);
  EXPECT_EQ(count(lowered({Op::tan}), Op::div), 1u);
  EXPECT_EQ(count(lowered({Op::atan}), Op::div), 1u);
}

TEST_P(AngleFunctions, have_no_value_beyond_the_largest_angle) {
  const double end = elementary::largest_angle(type());
  EXPECT_GE(end, 1e4);
  for (const Op op : {Op::sin, Op::cos, Op::tan}) {
    const Function f = function(op);
    for (const double sign : {1.0, -1.0}) {
      EXPECT_FALSE(std::isnan(f(sign * end))) << info(op).name;
      for (const double x : {above(end), infinity}) EXPECT_TRUE(std::isnan(f(sign * x))) << info(op).name;
    }
    EXPECT_TRUE(std::isnan(f(std::nan("")))) << info(op).name;
  }
}

TEST_P(AngleFunctions, have_the_right_sign_after_any_number_of_quarter_turns) {
  const Function sine = function(Op::sin), cosine = function(Op::cos), tangent = function(Op::tan);
  for (int k = -100; k <= 100; ++k) {
    const double x = rounded((k + 0.5) * pi / 2);
    const int quadrant = ((k % 4) + 4) % 4;
    EXPECT_EQ(sine(x) > 0, quadrant < 2) << k;
    EXPECT_EQ(cosine(x) > 0, quadrant == 0 || quadrant == 3) << k;
    EXPECT_EQ(tangent(x) > 0, quadrant % 2 == 0) << k;
    EXPECT_NEAR(sine(x) * sine(x), 0.5, 1e-4);
  }
}

TEST_P(AngleFunctions, are_odd_about_zero_with_its_sign) {
  const double tiny = type() == f32 ? 0x1p-149 : 0x1p-1074;
  for (const Op op : {Op::sin, Op::tan, Op::asin, Op::atan}) {
    const Function f = function(op);
    for (const double x : {0.0, tiny, 3 * tiny, 0x1p-60, 0.25, 0.75, 0.984375, 1.0})
      for (const double sign : {1.0, -1.0}) {
        EXPECT_EQ(std::signbit(f(sign * x)), sign < 0) << info(op).name << ' ' << sign * x;
        EXPECT_EQ(f(sign * x), sign * f(x)) << info(op).name << ' ' << x;
        if (x < 0x1p-50) { EXPECT_EQ(f(sign * x), sign * x) << info(op).name; }
      }
  }
}

TEST_P(AngleFunctions, end_where_their_inverses_do) {
  const Function arcsine = function(Op::asin), arccosine = function(Op::acos),
                 arctangent = function(Op::atan);
  expect_near(arcsine(1), pi / 2);
  expect_near(arcsine(-1), -pi / 2);
  EXPECT_EQ(arccosine(1), 0);
  EXPECT_FALSE(std::signbit(arccosine(1)));
  expect_near(arccosine(-1), pi);
  expect_near(arctangent(infinity), pi / 2);
  expect_near(arctangent(-infinity), -pi / 2);
  for (const double x : {above(1), 2.0, infinity})
    for (const double sign : {1.0, -1.0}) {
      EXPECT_TRUE(std::isnan(arcsine(sign * x))) << x;
      EXPECT_TRUE(std::isnan(arccosine(sign * x))) << x;
    }
  const double near_one = below(1);
  expect_near(arccosine(near_one), std::acos(near_one));
}

TEST_P(AngleFunctions, the_angle_of_a_vector_is_right_at_zeros_and_infinities) {
  const Function angle = function(Op::atan2);
  const std::array numbers{0.0, 1.0, type() == f32 ? 0x1p-149 : 0x1p-1074, type() == f32 ? 0x1p127 : 0x1p1023,
                           infinity};
  for (const double y : numbers)
    for (const double x : numbers)
      for (const double y_sign : {1.0, -1.0})
        for (const double x_sign : {1.0, -1.0}) {
          const double got = angle(y_sign * y, x_sign * x), right = std::atan2(y_sign * y, x_sign * x);
          SCOPED_TRACE(testing::Message() << y_sign * y << ' ' << x_sign * x);
          expect_near(got, rounded(right));
          EXPECT_EQ(std::signbit(got), std::signbit(right));
        }
  for (const double x : {0.0, 1.0, infinity, std::nan("")}) {
    EXPECT_TRUE(std::isnan(angle(std::nan(""), x))) << x;
    EXPECT_TRUE(std::isnan(angle(x, std::nan("")))) << x;
  }
}

// Powers of 2 times a vector have its angle, wherever they lie in the range.
TEST_P(AngleFunctions, the_angle_of_a_vector_is_that_of_its_multiples) {
  const Function angle = function(Op::atan2);
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(-1, 1);
  const int last = type() == f32 ? 126 : 1022;
  for (int i = 0; i < 300; ++i) {
    const double y = rounded(unit(random)), x = rounded(unit(random));
    const double right = angle(y, x);
    for (const int e : {-last + 40, -last / 2, -1, 1, last / 3, last / 2, last}) {
      if (std::min(std::abs(x), std::abs(y)) < 0x1p-10) continue;
      EXPECT_EQ(angle(std::ldexp(y, e), std::ldexp(x, e)), right) << y << ' ' << x << ' ' << e;
    }
  }
}

}  // namespace
}  // namespace imp
