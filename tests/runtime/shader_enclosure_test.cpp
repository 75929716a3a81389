// Enclosures by shaders of formulas with domains and poles: a driver keeps no sign of a zero, and no value may lie
// outside for that (docs/decisions/glsl.md).
#include <gtest/gtest.h>

#include <array>

#include "ir/text.h"
#include "passes/extend/inclusion.h"
#include "passes/rewrite.h"
#include "runtime/kernel.h"
#include "tests/support/ball.h"
#include "tests/support/boxes.h"
#include "tests/support/composer.h"
#include "tests/support/effort.h"
#include "tests/support/formula.h"
#include "tests/support/shader.h"

namespace imp::test {
namespace {

using Ends = std::array<std::vector<double>, 4>;

// Boxes of which many end at 0, at 1 or at -1, where domains end and poles are.
Ends some_boxes(Boxes& boxes, std::size_t size) {
  const auto side = [&] {
    Box1 box = boxes.pick(3) == 0 ? boxes.box() : boxes.within(-4, 4);
    const double edge = std::array{0.0, 0.0, 1.0, -1.0}[boxes.pick(4)];
    if (boxes.pick(2) == 0) (boxes.pick(2) == 0 ? box.lo : box.hi) = edge;
    return box.lo <= box.hi ? box : Box1{box.hi, box.lo};
  };
  Ends ends;
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t k = 0; k < 4; k += 2) {
      const Box1 box = side();
      ends[k].push_back(box.lo), ends[k + 1].push_back(box.hi);
    }
  return ends;
}

// By the shader of `form`, where there is one that is not too long; how many values were compared.
std::size_t expect_no_value_outside(const Program& f, const char* form, std::uint64_t seed) {
  constexpr std::size_t size = 400;
  Diagnostics diagnostics;
  const auto extended = extension(f, *inclusion_named(form)->enclose, f32, diagnostics);
  if (!extended) return 0;
  const auto kernel = make_kernel(*extended, {.backend = Backend::glsl});
  if (!kernel) return 0;
  Boxes boxes(seed);
  const Ends ends = some_boxes(boxes, size);
  std::vector<double> lo(size), hi(size);
  std::vector<unsigned char> defined(size);
  const std::array<const void*, 4> in{ends[0].data(), ends[1].data(), ends[2].data(), ends[3].data()};
  const std::array<void*, 3> out{lo.data(), hi.data(), defined.data()};
  (*kernel)->run({size, in, out});

  std::size_t compared = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const Box1 x{ends[0][i], ends[1][i]}, y{ends[2][i], ends[3][i]};
    const bool empty = lo[i] == INFINITY && hi[i] == -INFINITY;
    EXPECT_TRUE(lo[i] <= hi[i] || empty)
        << form << " over " << to_text(x) << ", " << to_text(y) << ": " << to_text(Box1{lo[i], hi[i]});
    for (int k = 0; k < 6; ++k) {
      const std::array at{boxes.inside(x), boxes.inside(y)};
      const Ball value = ball_values(f, at)[0];
      compared += value.is(Ball::State::number) ? 1 : 0;
      EXPECT_FALSE(value.certainly_outside(lo[i], hi[i]))
          << form << " over " << to_text(x) << ", " << to_text(y) << " at " << at[0] << ", " << at[1] << ": "
          << value.nearest() << " is not in " << to_text(Box1{lo[i], hi[i]});
      EXPECT_FALSE(value.is(Ball::State::none) && defined[i] != 0)
          << form << " at " << at[0] << ", " << at[1];
    }
  }
  return compared;
}

const std::vector<NamedFormula> formulas{
    {"quotient of a root", [](Expr x, Expr y) { return sqrt(x) * y / sqrt(x); }},
    {"sum of such", [](Expr x, Expr y) { return 1.0 + sqrt(4.0 - x - y) * x / sqrt(4.0 - x - y); }},
    {"negative power", [](Expr x, Expr y) { return make(Op::powi, sqrt(x), constant_like(x, -3)) - y; }},
    {"even power", [](Expr x, Expr y) { return make(Op::powi, x, constant_like(x, -2)) * y; }},
    {"real power", [](Expr x, Expr y) { return make(Op::pow, abs(x), y); }},
    {"angle", [](Expr x, Expr y) { return make(Op::atan2, sqrt(y), x); }},
    {"angle of an area", [](Expr x, Expr y) { return make(Op::atan2, y * y, x); }},
    {"logarithm", [](Expr x, Expr y) { return make(Op::log, sqrt(x)) / y; }},
    {"remainder", [](Expr x, Expr y) { return make(Op::mod, y, sqrt(x)); }},
    {"arcs", [](Expr x, Expr y) { return make(Op::acos, x) / make(Op::asin, y); }},
    {"hyperbolic", [](Expr x, Expr y) { return make(Op::atanh, x) / make(Op::acosh, y); }},
    {"tangent", [](Expr x, Expr y) { return y / make(Op::tan, sqrt(x)); }},
    {"cube root", [](Expr x, Expr y) { return y / make(Op::cbrt, sqrt(x)); }},
};

TEST(ShaderEnclosure, of_domains_and_poles_holds_every_value) {
  IMP_NEEDS_GL();
  for (const NamedFormula& formula : formulas) {
    SCOPED_TRACE(formula.name);
    const Program f = program_of(formula.build);
    for (const char* form : {"ia", "af1", "mean-value", "slope"}) {
      const std::size_t compared = expect_no_value_outside(f, form, 1);
      if (std::string_view(form) == "ia") { EXPECT_GT(compared, 100u); }
      if (testing::Test::HasFailure()) return;
    }
  }
}

// What holds no variable is a constant, and no shader computes it.
bool is_constant(const Program& f) {
  const std::vector<bool> live = live_nodes(f);
  for (std::uint32_t i = 0; i < f.graph.size(); ++i)
    for (const Id arg : f.graph[Id{i}].args)
      if (live[i] && f.graph[arg].op == Op::input) return false;
  return true;
}

TEST(ShaderEnclosure, of_random_formulas_holds_every_value) {
  IMP_NEEDS_GL();
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < effort(60); ++seed) {
    const Program f = program_of([&](Expr x, Expr y) { return Composer(x, y, seed, true).formula(3); });
    SCOPED_TRACE("seed " + std::to_string(seed) + "\n" + to_text(f));
    if (is_constant(f)) continue;
    compared += expect_no_value_outside(f, seed % 3 == 0 ? "mean-value" : "ia", seed);
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(compared, 1000u);
}

}  // namespace
}  // namespace imp::test
