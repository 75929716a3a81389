// Sign variations: the most that the bounds allow, and never fewer than there are zeros.
#include "passes/polynomial/sign_variations.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "passes/polynomial/bernstein.h"
#include "tests/support/ray_pieces.h"

namespace imp::test {
namespace {

int variations(const std::vector<int>& signs) {
  int count = 0, last = 0;
  for (const int sign : signs) {
    if (sign == 0) continue;
    if (last != 0 && sign != last) ++count;
    last = sign;
  }
  return count;
}

// Over all signs that bounds allow.
int most(std::span<const Ends> bounds, std::vector<int>& signs) {
  if (signs.size() == bounds.size()) return variations(signs);
  int result = 0;
  const auto [lo, hi] = bounds[signs.size()];
  for (const int sign : {-1, 0, 1}) {
    const bool impossible = sign < 0 ? lo >= 0 : sign > 0 ? hi <= 0 : lo > 0 || hi < 0;
    if (impossible) continue;
    signs.push_back(sign);
    result = std::max(result, most(bounds, signs));
    signs.pop_back();
  }
  return result;
}

TEST(SignVariations, are_the_most_that_bounds_allow) {
  constexpr Ends choices[] = {{1, 2}, {-2, -1}, {-1, 1},   {0, 1},    {-1, 0},
                              {0, 0}, {NAN, 1}, {-1, NAN}, {NAN, NAN}};
  Random random(0x5197);
  for (const std::size_t count : {1u, 2u, 3u, 4u, 7u}) {
    Program program{.name = "variations"};
    std::vector<Interval> b;
    for (std::size_t i = 0; i < count; ++i) {
      const Expr lo = input(program, "lo"), hi = input(program, "hi");
      b.push_back(interval(-lo, hi));
    }
    output(program, "count", most_sign_variations(b));
    const auto kernel = interpret(upward(program));
    for (int i = 0; i < 300; ++i) {
      std::vector<Ends> bounds;
      std::vector<double> numbers;
      for (std::size_t k = 0; k < count; ++k) {
        bounds.push_back(choices[random.below(std::size(choices))]);
        numbers.insert(numbers.end(), {bounds.back().lo, bounds.back().hi});
      }
      numbers.push_back(0);
      std::vector<int> signs;
      EXPECT_EQ(evaluate(*kernel, numbers)[0], most(bounds, signs)) << testing::PrintToString(numbers);
    }
  }
}

// Products of x - r and of what is positive, along rays: how many of the r a piece holds is known.
TEST(SignVariations, are_no_fewer_than_the_zeros_within) {
  Random random(0x2e205);
  for (int round = 0; round < 25; ++round)
    for (const Type type : {f32, f64}) {
      Program f{.name = "f"};
      const Expr x = input(f, "x", f64);
      input(f, "y", f64), input(f, "z", f64), input(f, "w", f64, Rate::frame);
      std::vector<double> roots;
      Expr product = one(x);
      for (std::size_t i = 0, count = 1 + random.below(7); i < count; ++i) {
        roots.push_back(!roots.empty() && random.one_in(4) ? roots.back() : random.between(-1, 1));
        product = product * (x - roots.back());
      }
      if (random.one_in(2)) product = product * (x * x + 0.01);
      output(f, "f", product);
      for (auto* way : {bernstein_by_samples, bernstein_by_powers, bernstein_by_products}) {
        const PieceKernel kernel(f, type, [&](const Program& along, std::span<const Interval> inputs) {
          Diagnostics diagnostics;
          const auto found = way(along, {inputs, first_input}, diagnostics);
          return std::vector{point(most_sign_variations(found->front().coefficients))};
        });
        for (int i = 0; i < 30; ++i) {
          const RayPiece ray = random_piece(random, type, 1);
          if (ray.d[0] == 0) continue;
          int within = 0;
          for (const double root : roots) {
            const Rational s = (Rational(root) - Rational(ray.o[0])) / Rational(ray.d[0]);
            within += Rational(ray.s0) < s && s < Rational(ray.s1);
          }
          EXPECT_GE(kernel(ray)[0].hi, within) << testing::PrintToString(roots);
        }
      }
    }
}

// (x - 1/4)(x - 3/4) over [0, 1]: both zeros, and then one in each half.
TEST(SignVariations, are_the_zeros_of_a_parabola) {
  Program program{.name = "variations"};
  std::vector<Interval> b;
  for (const double value : {0.1875, -0.3125, 0.1875}) b.push_back(point(number(program, value)));
  output(program, "count", most_sign_variations(b));
  output(program, "left", most_sign_variations(std::span(b).first(2)));
  EXPECT_EQ(evaluate(program, {}), (std::vector<double>{2, 1}));
}

}  // namespace
}  // namespace imp::test
