// Blossoms along lines enclose the exact Bernstein coefficients.
#include "passes/polynomial/blossom.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "ir/text.h"
#include "tests/support/random_polynomial.h"
#include "tests/support/ray_pieces.h"

namespace imp::test {
namespace {

class Blossom : public testing::TestWithParam<Type> {};

// A net around [-2, 2] x [0, 2] x [-1, 5], and segments between two points of it.
TEST_P(Blossom, encloses_the_exact_coefficients) {
  constexpr std::array<Range, 3> box{{{-2, 2}, {0, 2}, {-1, 5}}};
  const Type type = GetParam();
  Random random(0xb105);
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const RandomPolynomial polynomial(seed, static_cast<std::uint32_t>(seed % 8));
    const Program& f = polynomial.program();
    Program kernel{.name = "kernel"};
    SpacePoint ends[2];
    for (SpacePoint& end : ends)
      for (Interval& x : end) x = point(input(kernel, "x", type));
    const Interval w[] = {point(input(kernel, "w", type, Rate::frame))};
    Diagnostics diagnostics;
    const auto net = control_net(f, box, w, w[0].hi, diagnostics);
    ASSERT_TRUE(net) << to_text(diagnostics);
    for (const Interval& b : blossomed(*net, ends[0], ends[1])) {
      output(kernel, "nlo", b.nlo);
      output(kernel, "hi", b.hi);
    }
    const auto compiled = interpret(compact(kernel));

    for (int i = 0; i < 15; ++i) {
      std::vector<double> numbers;
      for (std::size_t k = 0; k < 6; ++k) {
        const Range& side = box[k % 3];
        const double margin = 0.05 * (side.hi - side.lo);
        numbers.push_back(random.one_in(4) ? side.hi : random.between(side.lo - margin, side.hi + margin));
      }
      numbers.push_back(random.between(-1, 1));
      if (type == f32)
        for (double& x : numbers) x = static_cast<float>(x);
      std::vector<RationalPolynomial> line;
      for (std::size_t k = 0; k < 3; ++k)
        line.push_back({Rational(numbers[k]), Rational(numbers[k + 3]) - Rational(numbers[k])});
      line.push_back(constant(numbers[6]));
      const auto exact = bernstein_of(run_exactly(f, line), net->degree);
      const auto found = evaluate(*compiled, numbers);
      ASSERT_EQ(found.size(), 2 * exact.size());
      for (std::size_t k = 0; k < exact.size(); ++k)
        ASSERT_TRUE(lies_in(exact[k], -found[2 * k], found[2 * k + 1]))
            << fmt::format("seed {}, coefficient {} of {}: {} not in [{}, {}]\n", seed, k, exact.size(),
                           exact[k].get_d(), -found[2 * k], found[2 * k + 1])
            << to_text(f);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(precision, Blossom, testing::Values(f32, f64),
                         [](const auto& test) { return to_text(test.param); });

// x^2 over the tetrahedron around [-1, 1]^3, whose corners have x = ±3.25: the mean of the squares is a corner's.
TEST(ControlNet, of_a_square) {
  Program f{.name = "f"};
  const Expr x = input(f, "x", f64);
  input(f, "y", f64), input(f, "z", f64);
  output(f, "f", x * x);
  Graph graph;
  Diagnostics diagnostics;
  const auto net =
      control_net(f, {{{-1, 1}, {-1, 1}, {-1, 1}}}, {}, {&graph, graph.constant(f32, 0)}, diagnostics);
  ASSERT_TRUE(net);
  EXPECT_EQ(net->degree, 2u);
  EXPECT_EQ(net->coefficients.size(), 10u);
  for (const auto& [powers, value] : net->coefficients) {
    const double sign = (powers[0] + powers[1]) % 2 == 0 ? 1 : -1;
    EXPECT_EQ(graph.number(value.hi.id), sign * 3.25 * 3.25);
    EXPECT_EQ(graph.number(value.nlo.id), sign * -3.25 * 3.25);
  }
}

}  // namespace
}  // namespace imp::test
