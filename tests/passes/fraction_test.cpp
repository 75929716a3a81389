// The numerator has the zeros of the fraction, and no others where the divisors are not 0.
#include "passes/fraction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "ir/verify.h"
#include "tests/support/catalogue.h"
#include "tests/support/evaluate.h"
#include "tests/support/random.h"

namespace imp::test {
namespace {

Program formula(const std::string& source) { return model_of(source).surfaces.at(0).f; }

TEST(Fraction, clears_divisors_that_change_sign) {
  for (const char* source :
       {"x + y", "1/(x^2 + 1) + y", "y/x^2", "y/2", "max(1/x, y)", "exp(1/x)", "x^-2 + y"})
    EXPECT_FALSE(fraction(formula(source)).poles.has_value()) << source;
  for (const char* source :
       {"1/x + y", "tan(x) + y", "x^-3 + y", "y/(1/x)", "1/x - 1/x", "(y + 1/x)^2", "-(1/x)"})
    EXPECT_TRUE(fraction(formula(source)).poles.has_value()) << source;
}

TEST(Fraction, leaves_divisors_without_variables) {
  EXPECT_FALSE(fraction(formula("param a = 1\nx/a + y")).poles.has_value());
  EXPECT_FALSE(fraction(formula("param a = 1\nx + tan(a)")).poles.has_value());
}

TEST(Fraction, leaves_many_divisors) {
  EXPECT_FALSE(fraction(formula("1/x + 1/y + 1/z + 1/(x + y) + 1/(y + z) = 1")).poles.has_value());
}

// f d = numerator for a d that is not 0, at random places: so the quotient of f and the numerator is made of the
// divisors alone. Where a divisor is 0, poles is.
TEST(Fraction, has_the_zeros_of_the_formula) {
  struct Example {
    const char* source;
    std::function<double(double, double, double)> divisor;
  };
  const Example examples[] = {
      {"1/x + y + z", [](double x, double, double) { return x; }},
      {"1/x + y/x + z", [](double x, double, double) { return x; }},
      {"1/x + z/(x*y)", [](double x, double y, double) { return x * x * y; }},
      {"x*y - z/(x + y)", [](double x, double y, double) { return x + y; }},
      {"tan(x) - y*tan(z)", [](double x, double, double z) { return std::cos(x) * std::cos(z); }},
      {"(y + 1/x)^3 - z", [](double x, double, double) { return x * x * x; }},
      {"(y + z/x)^-3 - 1", [](double x, double y, double z) { return std::pow(x * y + z, 3); }},
      {"y/(z + 1/x) - 2", [](double x, double, double z) { return x * z + 1; }},
      {"-(1/x)/(x^2 + 1) + y", [](double x, double, double) { return x; }},
  };
  for (const Example& example : examples) {
    const Program f = formula(example.source);
    const Fraction parts = fraction(f);
    ASSERT_TRUE(parts.poles) << example.source;
    EXPECT_EQ(verify(parts.numerator), "") << example.source;
    EXPECT_EQ(verify(*parts.poles), "") << example.source;
    Random random(5);
    for (int i = 0; i < 100; ++i) {
      const std::vector<double> place{random.between(-2, 2), random.between(-2, 2), random.between(-2, 2)};
      const double value = evaluate(f, place).front(), above = evaluate(parts.numerator, place).front(),
                   pole = evaluate(*parts.poles, place).front();
      const double divisor = example.divisor(place[0], place[1], place[2]);
      EXPECT_NEAR(value * divisor, above, 1e-9 * (1 + std::abs(above))) << example.source;
      EXPECT_NE(pole, 0) << example.source;
    }
  }
}

// What is not a value of f is a pole, though the numerator has a value there.
TEST(Fraction, knows_poles_that_cancel) {
  for (const char* source : {"1/(1/x) + y", "x/x + y", "1/x - 1/x + y", "y*(1/x)*x"}) {
    const Fraction parts = fraction(formula(source));
    ASSERT_TRUE(parts.poles) << source;
    const std::vector<double> place{0, 1, 1};
    EXPECT_EQ(evaluate(*parts.poles, place).front(), 0) << source;
  }
}

}  // namespace
}  // namespace imp::test
