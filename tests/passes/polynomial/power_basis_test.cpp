// Coefficients in the power basis enclose the exact ones, and no work is done for those that are 0.
#include "passes/polynomial/power_basis.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>

#include "ir/text.h"
#include "tests/support/cost.h"
#include "tests/support/random_polynomial.h"
#include "tests/support/ray_pieces.h"

namespace imp::test {
namespace {

// In s itself: what the piece is plays no part.
std::vector<Interval> in_s(const Program& along, std::span<const Interval> inputs) {
  Diagnostics diagnostics;
  const Expr like = inputs[1].hi;
  const Substitution itself{{variable(0, point(one(like)))}};
  const auto found = power_basis(along, {inputs, first_input}, itself, diagnostics);
  EXPECT_TRUE(found) << to_text(diagnostics);
  const std::uint32_t degree = found->front().empty() ? 0 : found->front().rbegin()->first[0];
  return in_order(found->front(), degree, like);
}

class PowerBasis : public testing::TestWithParam<Type> {};

TEST_P(PowerBasis, encloses_the_exact_coefficients) {
  Random random(0x90e5);
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const RandomPolynomial polynomial(seed, static_cast<std::uint32_t>(seed % 13));
    const PieceKernel kernel(polynomial.program(), GetParam(), in_s);
    for (int i = 0; i < 20; ++i) {
      RayPiece ray = random_piece(random, GetParam());
      ray.s0 = 0, ray.s1 = 1;
      const auto found = kernel(ray);
      auto exact = exact_along(polynomial.program(), ray);
      exact.resize(std::max(exact.size(), found.size()));
      for (std::size_t k = 0; k < exact.size(); ++k) {
        const Ends ends = k < found.size() ? found[k] : Ends{0, 0};
        ASSERT_TRUE(lies_in(exact[k], ends.lo, ends.hi))
            << fmt::format("seed {}, coefficient {} of {}: {} not in [{}, {}]\n", seed, k, found.size(),
                           exact[k].get_d(), ends.lo, ends.hi)
            << to_text(polynomial.program());
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(precision, PowerBasis, testing::Values(f32, f64),
                         [](const auto& test) { return to_text(test.param); });

// The coefficients of a formula in x as intervals at given w, printed "power: lo hi".
std::string coefficients_of(const std::function<Expr(Expr x, Expr w)>& formula, double wlo, double whi) {
  Program f{.name = "f"}, kernel{.name = "kernel"};
  const Expr x = input(f, "x", f64);
  output(f, "f", formula(x, input(f, "w", f64, Rate::frame)));
  const Expr lo = input(kernel, "lo", f64), hi = input(kernel, "hi", f64);
  const Interval inputs[] = {interval(-lo, hi), interval(-lo, hi)};
  const Substitution itself{{variable(0, point(one(lo)))}};
  Diagnostics diagnostics;
  const auto found = power_basis(f, {inputs, first_input}, itself, diagnostics);
  if (!found) return to_text(diagnostics);
  for (const auto& [powers, value] : found->front()) {
    output(kernel, "nlo", value.nlo), output(kernel, "hi", value.hi);
    output(kernel, "empty", value.empty), output(kernel, "continuous", value.continuous);
  }
  const auto values = evaluate(kernel, {wlo, whi});
  std::string text;
  std::size_t i = 0;
  for (const auto& [powers, value] : found->front()) {
    text += fmt::format("{}: {} {}{}; ", powers[0], -values[i] + 0.0, values[i + 1],
                        values[i + 2] != 0   ? " empty"
                        : values[i + 3] == 0 ? " broken"
                                             : "");
    i += 4;
  }
  return text;
}

TEST(PowerBasisOf, small_examples) {
  const auto at = [](double lo, double hi, const std::function<Expr(Expr, Expr)>& formula) {
    return coefficients_of(formula, lo, hi);
  };
  EXPECT_EQ(at(2, 3, [](Expr x, Expr w) { return w * x - 1.0; }), "0: -1 -1; 1: 2 3; ");
  EXPECT_EQ(at(2, 3, [](Expr x, Expr) { return (x + 1.0) * (x - 1.0); }), "0: -1 -1; 2: 1 1; ");
  EXPECT_EQ(at(-1, 1, [&](Expr x, Expr w) { return power(x + w, 2); }), "0: 0 1; 1: -2 2; 2: 1 1; ");
  EXPECT_EQ(at(-1, 2, [&](Expr x, Expr w) { return power(x * x - w, 3); }),
            "0: -8 1; 2: 0 12; 4: -6 3; 6: 1 1; ");
  EXPECT_EQ(at(2, 4, [&](Expr x, Expr w) { return power(x, 0) + x / w; }), "0: 1 1; 1: 0.25 0.5; ");
  EXPECT_EQ(at(1, 2, [&](Expr x, Expr w) { return select(w < 1.5, x, x * x); }),
            "1: 0 1 broken; 2: 0 1 broken; ");
  EXPECT_EQ(at(1, 1, [&](Expr x, Expr w) { return select(w < 1.5, x, x * x); }), "1: 1 1; 2: 0 0; ");
  EXPECT_EQ(at(-2, -1, [](Expr x, Expr w) { return x * sqrt(w) + 1.0; }).substr(0, 8), "0: 1 1; ");
  EXPECT_TRUE(at(-2, -1, [](Expr x, Expr w) { return x * sqrt(w) + 1.0; }).ends_with("empty; "));
  const auto zero_times_root = [](Expr x, Expr w) { return 0.0 * (x * sqrt(w)); };
  EXPECT_TRUE(at(-2, -1, zero_times_root).ends_with("empty; "));
  EXPECT_EQ(at(-1, 1, zero_times_root), "1: 0 0 broken; ");
  const auto root_to_the_0 = [](Expr x, Expr w) { return power(x * sqrt(w), 0); };
  EXPECT_EQ(at(-2, -1, root_to_the_0), "0: 1 1 empty; ");
  EXPECT_EQ(at(-1, 1, root_to_the_0), "0: 1 1 broken; ");
  EXPECT_EQ(at(0, 1, root_to_the_0), "0: 1 1; ");
  EXPECT_TRUE(at(0, 0, [](Expr x, Expr w) { return (x - x) * (x / w) + 1.0; }).ends_with("empty; "));
  EXPECT_EQ(at(0, 1, [](Expr x, Expr) { return x - x; }), "");
  EXPECT_EQ(at(0, 1, [](Expr x, Expr w) { return 0.0 * x + fma(x, -w, 2.0 * x); }), "1: 1 2; ");
  EXPECT_TRUE(
      at(0, 1, [](Expr x, Expr) { return sqrt(x); }).contains("'sqrt' makes this no polynomial in x"));
  EXPECT_TRUE(at(0, 1, [&](Expr x, Expr) { return power(x, 33); }).contains("of degree 33 has too many"));
}

}  // namespace
}  // namespace imp::test
