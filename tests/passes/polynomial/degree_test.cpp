// What is a polynomial, of which degree, and which op makes a formula none.
#include "passes/polynomial/degree.h"

#include <gtest/gtest.h>

#include <functional>

#include "tests/support/catalogue.h"
#include "tests/support/make.h"
#include "tests/support/random_polynomial.h"
#include "tests/support/rational.h"

namespace imp::test {
namespace {

constexpr std::size_t xyz[] = {0, 1, 2};

struct Formula {
  const char* name;
  std::function<Expr(Expr x, Expr y, Expr w)> build;
  std::uint32_t total, in_x, in_y;
};

const Formula polynomials[] = {
    {"constant", [](Expr x, Expr, Expr) { return one(x); }, 0, 0, 0},
    {"variable", [](Expr x, Expr, Expr) { return x; }, 1, 1, 0},
    {"sum", [](Expr x, Expr y, Expr) { return x + y * y; }, 2, 1, 2},
    {"difference", [](Expr x, Expr y, Expr) { return x * x - y; }, 2, 2, 1},
    {"product", [](Expr x, Expr y, Expr) { return x * x * y * x; }, 4, 3, 1},
    {"negative", [](Expr x, Expr, Expr) { return -x; }, 1, 1, 0},
    {"fma", [](Expr x, Expr y, Expr) { return fma(x, y, x * x * x); }, 3, 3, 1},
    {"power", [](Expr x, Expr y, Expr) { return power(x * y + 1.0, 5); }, 10, 5, 5},
    {"power 0", [](Expr x, Expr y, Expr) { return power(x, 0) * y; }, 1, 0, 1},
    {"quotient", [](Expr x, Expr, Expr w) { return x / (w + 1.0); }, 1, 1, 0},
    {"any coefficient", [](Expr x, Expr y, Expr w) { return x * sqrt(w) - abs(w) * y; }, 1, 1, 1},
    {"choice by a parameter", [](Expr x, Expr y, Expr w) { return select(w < 0, x * x, y); }, 2, 2, 1},
    {"powers of powers", [](Expr x, Expr, Expr) { return power(power(x, 1 << 20), 1 << 20); }, 1u << 30,
     1u << 30, 0},
};

const Formula others[] = {
    {"sqrt", [](Expr x, Expr, Expr) { return sqrt(x * x) + x; }, 0, 0, 0},
    {"div", [](Expr x, Expr y, Expr w) { return x * (w / y); }, 0, 0, 0},
    {"powi", [](Expr x, Expr, Expr) { return power(x, -2) + 1.0; }, 0, 0, 0},
    {"lt", [](Expr x, Expr y, Expr) { return select(x < 0, x * x, y); }, 0, 0, 0},
    {"abs", [](Expr x, Expr y, Expr) { return power(abs(x + y), 2); }, 0, 0, 0},
    {"min", [](Expr x, Expr y, Expr) { return min(x, y); }, 0, 0, 0},
    {"sin", [](Expr x, Expr, Expr) { return make(Op::sin, x) * x; }, 0, 0, 0},
};

Program program_of(const Formula& formula) {
  Program f{.name = "f"};
  const Expr x = input(f, "x", f64), y = input(f, "y", f64);
  input(f, "z", f64);
  output(f, "f", formula.build(x, y, input(f, "w", f64, Rate::frame)));
  return f;
}

TEST(Degree, of_polynomials) {
  for (const Formula& formula : polynomials) {
    Diagnostics diagnostics;
    const auto found = degrees(program_of(formula), xyz, diagnostics);
    ASSERT_TRUE(found) << formula.name << to_text(diagnostics);
    EXPECT_EQ(found->front().total, formula.total) << formula.name;
    EXPECT_EQ(found->front().in, (std::vector<std::uint32_t>{formula.in_x, formula.in_y, 0})) << formula.name;
  }
}

TEST(Degree, refuses_what_is_none_at_the_op) {
  for (const Formula& formula : others) {
    Program f = program_of(formula);
    for (std::uint32_t i = 0; i < f.graph.size(); ++i)
      if (info(f.graph[Id{i}].op).name == formula.name) f.graph.set_span(Id{i}, {0, 7, 9});
    Diagnostics diagnostics;
    EXPECT_FALSE(degrees(f, xyz, diagnostics));
    ASSERT_EQ(diagnostics.errors(), 1u) << formula.name;
    EXPECT_EQ(diagnostics.all()[0].message,
              "'" + std::string(formula.name) + "' makes this no polynomial in x, y, z");
    EXPECT_EQ(diagnostics.all()[0].span.begin, 7u) << formula.name;
  }
}

TEST(Degree, only_what_an_output_needs_counts) {
  Program f{.name = "f"};
  const Expr x = input(f, "x", f64);
  output(f, "f", x * x);
  sqrt(x);
  Diagnostics diagnostics;
  EXPECT_TRUE(degrees(f, std::array{std::size_t{0}}, diagnostics));
}

// A polynomial of degree n has no more than n + 1 coefficients.
TEST(Degree, bounds_the_degree_along_random_lines) {
  Random random(0xde9);
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const auto n = static_cast<std::uint32_t>(1 + seed % 12);
    const RandomPolynomial polynomial(seed, n);
    std::vector<RationalPolynomial> line;
    for (int i = 0; i < 3; ++i)
      line.push_back({Rational(random.between(-2, 2)), Rational(random.between(-2, 2))});
    line.push_back(constant(0.75));
    Diagnostics diagnostics;
    const auto found = degrees(polynomial.program(), xyz, diagnostics);
    ASSERT_TRUE(found);
    EXPECT_LE(found->front().total, n);
    RationalPolynomial exact = run_exactly(polynomial.program(), line);
    while (!exact.empty() && exact.back() == 0) exact.pop_back();
    EXPECT_LE(exact.size(), found->front().total + 1);
  }
}

TEST(Degree, of_the_catalogue) {
  const auto total = [](const char* name) -> std::uint32_t {
    Diagnostics diagnostics;
    const Model model = model_of(entry_named(name));
    const auto found = degrees(model.surfaces.at(0).f, xyz, diagnostics);
    return found ? found->front().total : 0;
  };
  EXPECT_EQ(total("sphere"), 2u);
  EXPECT_EQ(total("cayley"), 3u);
  EXPECT_EQ(total("steiner"), 4u);
  EXPECT_EQ(total("dervish"), 5u);
  EXPECT_EQ(total("barth_sextic"), 6u);
  EXPECT_EQ(total("labs_septic"), 7u);
  EXPECT_EQ(total("barth_decic"), 10u);
  EXPECT_EQ(total("decocube"), 12u);
  EXPECT_EQ(total("sarti_dodecic"), 12u);
  EXPECT_EQ(total("chmutov_14"), 14u);
  EXPECT_EQ(total("water"), 0u);
}

}  // namespace
}  // namespace imp::test
