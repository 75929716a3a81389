// Chebyshev polynomials that are written out become the op; what is nearly one does not.
#include "passes/recognize_chebyshev.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>

#include "ir/text.h"
#include "ir/verify.h"
#include "tests/frontend/parse.h"
#include "tests/support/evaluate.h"
#include "tests/support/random_program.h"

namespace imp::test {
namespace {

// The degrees of the ops that are left, and how many products.
struct Found {
  std::multiset<unsigned> degrees;
  int products = 0;
};

Found found(const Program& p) {
  Found result;
  const Program live = compact(p);
  for (std::uint32_t i = 0; i < live.graph.size(); ++i) {
    const Node node = live.graph[Id{i}];
    if (node.op == Op::chebyshev)
      result.degrees.insert(static_cast<unsigned>(*live.graph.number(node.args[1])));
    result.products += node.op == Op::mul || node.op == Op::powi;
  }
  return result;
}

void expect_degrees(const std::string& text, std::multiset<unsigned> degrees, int products = 0) {
  const Program before = surface(text), after = recognize_chebyshev(before);
  ASSERT_EQ(verify(after), "");
  const Found is = found(after);
  EXPECT_EQ(is.degrees, degrees) << text << '\n' << to_text(after);
  EXPECT_EQ(is.products, products) << text << '\n' << to_text(after);
  EXPECT_TRUE(recognize_chebyshev(after) == after) << text << '\n' << to_text(after);
  Random random(0x7ec0);
  for (int i = 0; i < 20; ++i) {
    std::vector<double> at;
    for (std::size_t k = 0; k < before.inputs.size(); ++k) at.push_back(random.between(-1, 1));
    EXPECT_NEAR(evaluate(before, at)[0], evaluate(after, at)[0], 1e-4) << text;
  }
}

TEST(RecognizeChebyshev, finds_them_however_they_are_written) {
  expect_degrees("4*x^3 - 3*x = 0", {3});
  expect_degrees("32*x^6-48*x^4+18*x^2-1 = 0", {6});
  expect_degrees("2*x^2*(3-4*x^2)^2-1 = 0", {6});
  expect_degrees("((32*x^2 - 48)*x^2 + 18)*x^2 - 1 = 0", {6});
  expect_degrees("a = 4*x^3 - 3*x\n2*a^2 - 1 = 0", {6});
  expect_degrees("a = 16*x^5-20*x^3+5*x\nb = 16*a^5-20*a^3+5*a\n2*b^2-1 = 0", {50});
  expect_degrees("a = 2*x^2 - 1\nb = 2*x*a - x\nc = 2*x*b - a\n2*x*c - b = 0", {5});
  expect_degrees("2*T(7, x)*T(5, x) - T(2, x) = 0", {12});
  expect_degrees("T(2, T(7, x)) = 0", {14});
  expect_degrees("8*x^2*(x^2 - 1) = -1", {4});
}

TEST(RecognizeChebyshev, finds_them_scaled_and_in_sums) {
  expect_degrees("12*x^3 - 9*x = 5", {3}, 1);
  expect_degrees("3*y + 8*x^4 - 8*x^2 = 0", {4}, 1);
  expect_degrees("32*x^6-48*x^4+18*x^2-1 + 32*y^6-48*y^4+18*y^2-1 + 32*z^6-48*z^4+18*z^2-1 = 0", {6, 6, 6});
  expect_degrees("32*(x^6+y^6+z^6) - 48*(x^4+y^4+z^4) + 18*(x^2+y^2+z^2) - 3 = 0", {6, 6, 6});
  expect_degrees("T(6, x) + T(6, y) + T(6, z) = 0", {6, 6, 6});
}

TEST(RecognizeChebyshev, finds_them_in_sub_expressions) {
  expect_degrees("u = x + y\n4*u^3 - 3*u = z", {3});
  expect_degrees("u = x*y\n4*u^3 - 3*u = z", {3}, 1);
  expect_degrees("u = exp(x)\n4*u^3 - 3*u = z", {3});
  expect_degrees("exp(4*x^3 - 3*x) = 1", {3});
}

TEST(RecognizeChebyshev, never_takes_what_is_nearly_one) {
  expect_degrees("32*x^6-48*x^4+18.0000000001*x^2-1 = 0", {}, 6);
  expect_degrees("4*x^3 - 3*y = 0", {}, 3);
  expect_degrees("4*x^3 - 3*x + x^2 = 0", {3}, 1);  // a part of the sum is one
  expect_degrees("2*x^2 - 1 = 0", {}, 2);
  expect_degrees("0.4*x^3 - 0.3*x = 0", {}, 3);  // 0.4 is no number of 160 bits
}

// A cancelled logarithm is still undefined below 0.
TEST(RecognizeChebyshev, keeps_domains) {
  const Program after = recognize_chebyshev(surface("4*x^3 - 3*x + log(x) - log(x) = 0"));
  EXPECT_TRUE(std::isnan(evaluate(after, {-0.5, 0, 0})[0]));
}

TEST(RecognizeChebyshev, keeps_random_programs_that_have_none) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Program p = random_program(seed, {.nodes = 30, .f32 = false});
    const Program after = recognize_chebyshev(p);
    ASSERT_EQ(verify(after), "") << seed;
    if (found(after).degrees != found(p).degrees) continue;
    EXPECT_TRUE(after == p) << seed << '\n' << to_text(p);
  }
}

}  // namespace
}  // namespace imp::test
