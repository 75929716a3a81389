// Bernstein coefficients enclose the exact ones, whatever the polynomial, the ray and the piece.
#include "passes/polynomial/bernstein.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>

#include "ir/text.h"
#include "ir/verify.h"
#include "passes/extend/forms.h"
#include "passes/polynomial/basis.h"
#include "tests/support/boxes.h"
#include "tests/support/random_polynomial.h"
#include "tests/support/ray_pieces.h"

namespace imp::test {
namespace {

using Way = std::optional<std::vector<Bernstein>>(const Program&, const InputBox&, Diagnostics&);

BuildIntervals coefficients(Way& way) {
  return [&way](const Program& along, std::span<const Interval> inputs) {
    Diagnostics diagnostics;
    const auto found = way(along, {inputs, first_input}, diagnostics);
    EXPECT_TRUE(found) << to_text(diagnostics);
    return found->front().coefficients;
  };
}

void expect_exact_coefficients_enclosed(Way& way, Type type) {
  Random random(0xbe27);
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const RandomPolynomial polynomial(seed, static_cast<std::uint32_t>(seed % 13));
    const PieceKernel kernel(polynomial.program(), type, coefficients(way));
    for (int i = 0; i < 20; ++i) {
      const RayPiece ray = random_piece(random, type);
      const auto found = kernel(ray);
      const auto exact = bernstein_of(exact_along(polynomial.program(), ray), found.size() - 1);
      for (std::size_t k = 0; k < found.size(); ++k)
        ASSERT_TRUE(lies_in(exact[k], found[k].lo, found[k].hi))
            << fmt::format("seed {}, coefficient {} of {}: {} not in [{}, {}]\n", seed, k, found.size(),
                           exact[k].get_d(), found[k].lo, found[k].hi)
            << to_text(polynomial.program());
    }
  }
}

class BernsteinOfType : public testing::TestWithParam<Type> {};

TEST_P(BernsteinOfType, encloses_the_exact_coefficients_by_samples) {
  expect_exact_coefficients_enclosed(bernstein_by_samples, GetParam());
}

TEST_P(BernsteinOfType, encloses_the_exact_coefficients_by_powers) {
  expect_exact_coefficients_enclosed(bernstein_by_powers, GetParam());
}

TEST_P(BernsteinOfType, encloses_the_exact_coefficients_by_products) {
  expect_exact_coefficients_enclosed(bernstein_by_products, GetParam());
}

INSTANTIATE_TEST_SUITE_P(precision, BernsteinOfType, testing::Values(f32, f64),
                         [](const auto& test) { return to_text(test.param); });

TEST(SamplePoints, are_symmetric_and_end_at_0_and_1) {
  for (std::uint32_t degree = 0; degree <= 32; ++degree) {
    const auto points = sample_points(degree);
    ASSERT_EQ(points.size(), degree + 1);
    for (std::size_t j = 0; j <= degree && degree > 0; ++j) {
      EXPECT_EQ(points[j], 1 - points[degree - j]);
      EXPECT_TRUE(j == 0 || points[j - 1] < points[j]);
      EXPECT_EQ(points[j] * 0x1p12, std::round(points[j] * 0x1p12));
    }
    EXPECT_EQ(points[0], 0);
  }
}

// f over boxes and along pieces: the form holds its exact values.
TEST_P(BernsteinOfType, form_holds_values_over_boxes) {
  Boxes boxes(0xb0c5);
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    const RandomPolynomial polynomial(seed, static_cast<std::uint32_t>(seed % 5));
    const Program& f = polynomial.program();
    Diagnostics diagnostics;
    const auto program = extension(f, bernstein_form, GetParam(), diagnostics);
    ASSERT_TRUE(program) << to_text(diagnostics);
    ASSERT_EQ(verify(*program), "");
    const auto kernel = interpret(*program);
    for (int i = 0; i < 10; ++i) {
      std::vector<double> ends;
      std::vector<Box1> box;
      for (int k = 0; k < 4; ++k) {
        box.push_back(boxes.pick(3) ? boxes.within(-2, 2) : boxes.box());
        ends.insert(ends.end(), {box.back().lo, box.back().hi});
      }
      const auto bounds = evaluate(*kernel, ends);
      EXPECT_EQ(bounds[2], 1);  // defined
      for (int k = 0; k < 4; ++k) {
        std::vector<RationalPolynomial> at;
        for (const Box1& side : box) at.push_back(constant(boxes.inside(side)));
        const RationalPolynomial value = run_exactly(f, at);
        ASSERT_TRUE(lies_in(value.empty() ? Rational(0) : value[0], bounds[0], bounds[1]))
            << fmt::format("seed {}: [{}, {}] from {}\n", seed, bounds[0], bounds[1], fmt::join(ends, ", "))
            << to_text(f);
      }
    }
  }
}

// Of x^2 the coefficients over [-1, 2] are 1, -2, 4; over [-1, 1] x [0, 1] those of x y are exact.
TEST(Bernstein, form_of_small_examples) {
  const auto over = [](const std::function<Expr(Expr, Expr)>& formula, std::initializer_list<double> box) {
    Program f{.name = "f"};
    const Expr x = input(f, "x", f64), y = input(f, "y", f64);
    output(f, "f", formula(x, y));
    Diagnostics diagnostics;
    return evaluate(*extension(f, bernstein_form, f32, diagnostics), box);
  };
  const std::vector<double> square{-2, 4, 1}, product{-1, 1, 1}, point{9, 9, 1};
  EXPECT_EQ(over([](Expr x, Expr) { return x * x; }, {-1, 2, 0, 0}), square);
  EXPECT_EQ(over([](Expr x, Expr y) { return x * y; }, {-1, 1, 0, 1}), product);
  EXPECT_EQ(over([](Expr x, Expr) { return x * x; }, {3, 3, 0, 0}), point);
}

TEST(Bernstein, sides_without_end_give_all_reals) {
  Program f{.name = "f"};
  const Expr x = input(f, "x", f64);
  output(f, "f", x * x * x);
  Diagnostics diagnostics;
  const auto program = extension(f, bernstein_form, f64, diagnostics);
  for (const auto& [lo, hi] : {std::pair{-INFINITY, 1.0}, {1.0, INFINITY}, {-INFINITY, INFINITY}})
    EXPECT_EQ(evaluate(*program, {lo, hi}), (std::vector<double>{-INFINITY, INFINITY, 1}));
}

TEST(Bernstein, a_coefficient_without_a_value_leaves_none) {
  Program f{.name = "f"};
  const Expr x = input(f, "x", f64), w = input(f, "w", f64, Rate::frame);
  output(f, "f", x * x + x * sqrt(w));
  Diagnostics diagnostics;
  const auto program = extension(f, bernstein_form, f64, diagnostics);
  EXPECT_EQ(evaluate(*program, {0, 1, -2, -1}), (std::vector<double>{INFINITY, -INFINITY, 0}));
  EXPECT_EQ(evaluate(*program, {0, 1, -1, 1})[2], 0);
  EXPECT_EQ(evaluate(*program, {0, 1, 0, 1}), (std::vector<double>{0, 2, 1}));
}

TEST(Bernstein, refuses_what_it_cannot_do_at_its_place) {
  const auto refusal = [](const std::function<Expr(Expr, Expr)>& formula) {
    Program f{.name = "f"};
    const Expr x = input(f, "x", f64), y = input(f, "y", f64);
    const Expr value = formula(x, y);
    f.graph.set_span(value.id, {0, 3, 4});
    output(f, "f", value);
    Diagnostics diagnostics;
    EXPECT_FALSE(extension(f, bernstein_form, f32, diagnostics));
    EXPECT_EQ(diagnostics.errors(), 1u);
    EXPECT_EQ(diagnostics.all()[0].span.begin, 3u);
    return diagnostics.all()[0].message;
  };
  EXPECT_EQ(refusal([](Expr x, Expr) { return make(Op::sin, x); }),
            "'sin' makes this no polynomial in x, y; use --inclusion=auto");
  EXPECT_EQ(
      refusal([](Expr x, Expr y) { return make(Op::powi, x, constant_like(x, 33)) * y; }),
      "the Bernstein form of this polynomial in x, y takes 34*2 values of it: at most 33 an axis and 343 "
      "in all are taken; use --inclusion=auto");
  EXPECT_EQ(
      refusal([](Expr x, Expr y) { return make(Op::powi, x * y, constant_like(x, 20)); }),
      "the Bernstein form of this polynomial in x, y takes 21*21 values of it: at most 33 an axis and 343 "
      "in all are taken; use --inclusion=auto");
}

}  // namespace
}  // namespace imp::test
