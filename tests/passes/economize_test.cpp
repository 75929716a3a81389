// Economised polynomials: within the error that is promised, and of lower degree.
#include "passes/economize.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "ir/verify.h"
#include "passes/sum_of_polynomials.h"
#include "tests/frontend/parse.h"
#include "tests/support/evaluate.h"
#include "tests/support/random.h"

namespace imp::test {
namespace {

// Of the first input, where all of f is one polynomial in each.
std::size_t degree(const Program& f) {
  const auto views = sums_of_polynomials(f, 3);
  const auto& parts = views[f.outputs[0].id.index]->parts;
  const auto part = parts.find(f.inputs[0].id);
  return part == parts.end() ? 0 : part->second.size();
}

// 1 + x + x^2/2 + …
std::string exponential(unsigned terms) {
  std::string text = "1";
  double factorial = 1;
  for (unsigned i = 1; i < terms; ++i) text += fmt::format(" + x^{}/{}", i, factorial *= i);
  return text;
}

// The values of the two, over the box, in doubles.
void expect_within(const Program& f, const Economized& e, std::span<const Range> box, Random& random) {
  ASSERT_EQ(verify(e.f), "");
  const auto before = interpret(f), after = interpret(e.f);
  for (int i = 0; i < 200; ++i) {
    std::vector<double> at;
    for (const Range& r : box) at.push_back(i < 2 ? (i == 0 ? r.lo : r.hi) : random.between(r.lo, r.hi));
    const double was = evaluate(*before, at)[0], is = evaluate(*after, at)[0];
    ASSERT_LE(std::abs(was - is), e.error + 1e-13 * (1 + std::abs(was)));
  }
}

TEST(Economize, cuts_what_does_not_matter) {
  const std::string text = exponential(16) + " + y*z + y^2 = 0";
  const Program f = surface(text);
  const Range box[] = {{-1, 1}, {-2, 2}, {-2, 2}};
  Random random(1);
  std::size_t last = 15;
  for (const double tolerance : {1e-12, 1e-8, 1e-4, 1e-2}) {
    const Economized e = economize(f, box, tolerance);
    EXPECT_LE(e.error, tolerance);
    EXPECT_GT(e.error, 0);
    expect_within(f, e, box, random);
    const auto views = sums_of_polynomials(e.f, 8);
    const auto part = views[e.f.outputs[0].id.index]->parts.at(e.f.inputs[0].id);
    EXPECT_LT(part.size(), last);
    last = part.size();
  }
  EXPECT_LE(last, 4u);
}

TEST(Economize, uses_all_of_the_tolerance) {
  const Program f = surface("x^4 = y");  // x^4 = (T_4 + 4 T_2 + 3)/8
  const Range box[] = {{-1, 1}, {-1, 1}, {-1, 1}};
  EXPECT_EQ(degree(economize(f, box, 0.1249).f), 4u);
  const Economized e = economize(f, box, 0.1251);
  EXPECT_EQ(degree(e.f), 2u);
  EXPECT_EQ(e.error, 0.125);
  EXPECT_EQ(evaluate(e.f, {0.5, 0, 0})[0], 0.25 - 0.125);
}

TEST(Economize, leaves_what_it_cannot_cut) {
  const Range box[] = {{-1, 1}, {-1, 1}, {-1, 1}};
  for (const char* text : {"x^4 + y^4 + z^4 = 1", "x*y*z = 1", "sin(x) + exp(y^5) = 0", "1 = 0*x"}) {
    const Program f = surface(text);
    const Economized e = economize(f, box, 1e-6);
    EXPECT_TRUE(e.f == f) << text;
    EXPECT_EQ(e.error, 0);
  }
  const Range unbounded[] = {{-INFINITY, INFINITY}, {0, 0}, {-1, INFINITY}};
  const Program f = surface("x^4 + y^4 + z^4 = 1");
  EXPECT_TRUE(economize(f, unbounded, 1e6).f == f);
}

TEST(Economize, keeps_its_promise_for_random_polynomials) {
  Random random(0xec0);
  int cuts = 0;
  for (int i = 0; i < 60; ++i) {
    std::string text = "0";
    for (const char* variable : {"x", "y", "z"})
      for (unsigned k = 1; k < 12; ++k)
        if (!random.one_in(3))
          text += fmt::format(" {} {}*{}^{}", random.one_in(2) ? "+" : "-",
                              std::ldexp(std::floor(random.between(0, 1024)), -static_cast<int>(5 + k)),
                              variable, k);
    text += random.one_in(2) ? " + 0.5*(x^7 - y^6 - 3) + x*y" : " - (z^5 + x^9)*0.25 - log(4 + z)";
    const Program f = surface(text + " = 0");
    std::vector<Range> box;
    for (int k = 0; k < 3; ++k) {
      const double a = random.between(-1.5, 1.5), b = random.between(-1.5, 1.5);
      box.push_back({std::min(a, b), std::max(a, b)});
    }
    const double tolerance = std::pow(10, random.between(-9, -1));
    const Economized e = economize(f, box, tolerance);
    EXPECT_LE(e.error, tolerance * (1 + 1e-9)) << text;
    expect_within(f, e, box, random);
    cuts += e.error > 0;
  }
  EXPECT_GT(cuts, 30);
}

}  // namespace
}  // namespace imp::test
