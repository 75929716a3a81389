// Exponents of which nobody can tell whether they are integers are refused, and no others.
#include "passes/exponents.h"

#include <gtest/gtest.h>

#include "tests/frontend/parse.h"

namespace imp::test {
namespace {

std::string answer(const char* text) {
  Diagnostics diagnostics;
  const bool good = check_exponents(surface(text), diagnostics);
  EXPECT_EQ(good, diagnostics.all().empty());
  return good ? "" : diagnostics.all().front().message;
}

TEST(Exponents, that_may_be_integers_are_refused) {
  const std::string two = "whether this exponent is the integer 2 cannot be decided; if it is, write 2";
  EXPECT_EQ(answer("x^(sqrt(2)*sqrt(2))"), two);
  EXPECT_EQ(answer("x^(2*cos(0))"), two);
  EXPECT_EQ(answer("y + x^log(exp(2))"), two);
  EXPECT_EQ(answer("x^(2 + log(exp(1e-60)))"), two);
  EXPECT_EQ(answer("n = 4*sin(1)^2 + 4*cos(1)^2\nx^(n/2)"), two);
}

TEST(Exponents, that_are_none_are_real) {
  for (const char* text :
       {"x^(1/3)", "x^pi", "x^(log(3)/log(2))", "x^sqrt(2)", "x^(1/0)", "x^(0.3/0.1)", "x^(2 + 1e-30)",
        "x^(2*log(exp(1)) - 1e-30)", "x^(1e20 + 0.5)", "x^y", "x^(y - y)", "param n = 2\nx^n", "sqrt(x)"})
    EXPECT_EQ(answer(text), "") << text;
}

}  // namespace
}  // namespace imp::test
