// Enclosures that rely on what is known over a domain: sound within it, and cheaper.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "ir/text.h"
#include "passes/extend/interval.h"
#include "passes/pass.h"
#include "passes/power.h"
#include "passes/precision.h"
#include "tests/support/boxes.h"
#include "tests/support/composer.h"
#include "tests/support/cost.h"
#include "tests/support/evaluate.h"
#include "tests/support/exact.h"
#include "tests/support/formula.h"

namespace imp::test {
namespace {

// From -xlo, xhi, -ylo, yhi to -flo, fhi and whether it is empty, in `type`; nothing where an op has no rule.
std::optional<Program> over_domain(const Program& f, std::span<const Range> domain, Type type) {
  Program boxes{.name = "boxes"};
  std::vector<Interval> sides;
  for (const char* name : {"x", "y"}) {
    const Expr nlo = input(boxes, fmt::format("n{}lo", name), type);
    sides.push_back(interval(nlo, input(boxes, fmt::format("{}hi", name), type)));
  }
  Diagnostics diagnostics;
  const auto values = enclose(f, sides, diagnostics, domain);
  if (!values) return std::nullopt;
  output(boxes, "nlo", (*values)[0].nlo);
  output(boxes, "hi", (*values)[0].hi);
  output(boxes, "empty", (*values)[0].empty);
  return boxes;
}

std::unique_ptr<Kernel> values_on_the_way(Program f) {
  for (std::uint32_t i = 0; i < f.graph.size(); ++i)
    if (f.graph[Id{i}].type.is_real()) f.outputs.push_back({fmt::format("node{}", i), Id{i}});
  return interpret(reduce_powers(in_precision(f, f64)));
}

double outward(double value, Type type) {
  if (type == f64) return value;
  const float nearest = static_cast<float>(value);
  return static_cast<double>(nearest) < value ? std::nextafter(nearest, INFINITY) : nearest;
}

Box1 within(Boxes& boxes, Box1 domain) {
  const double a = boxes.inside(domain), b = boxes.inside(domain);
  return {std::min(a, b), std::max(a, b)};
}

// Over random boxes within a domain. A value that overflows is no real number: nothing is said of it.
void expect_enclosed(const Program& f, std::span<const Range> domain, Boxes& boxes) {
  const auto values = values_on_the_way(f);
  for (const Type type : {f32, f64}) {
    const auto program = over_domain(f, domain, type);
    if (!program) return;
    const auto kernel = interpret(run_passes(*program, kernel_passes()));
    for (int i = 0; i < 10; ++i) {
      const Box1 x = within(boxes, {domain[0].lo, domain[0].hi}),
                 y = within(boxes, {domain[1].lo, domain[1].hi});
      const std::array at{boxes.inside(x), boxes.inside(y)};
      if (std::ranges::any_of(evaluate(*values, at), [](double v) { return std::isinf(v); })) continue;
      const Enclosure value = exact_values(f, at)[0];
      if (value.lo > value.hi) continue;  // undefined
      const auto v = evaluate(*kernel, std::array{outward(-x.lo, type), outward(x.hi, type),
                                                  outward(-y.lo, type), outward(y.hi, type)});
      ASSERT_TRUE(-v[0] <= value.hi && value.lo <= v[1] && v[2] == 0)
          << fmt::format("[{}, {}] x [{}, {}] at {}, {}: {} in [{}, {}], empty {}\n{}", x.lo, x.hi, y.lo,
                         y.hi, at[0], at[1], value.nearest, -v[0], v[1], v[2], to_text(f));
    }
  }
}

void expect_random_formulas_enclosed(std::uint64_t count, bool elementary) {
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    const Program f = program_of([&](Expr x, Expr y) { return Composer(x, y, seed, elementary).formula(4); });
    Boxes boxes(seed);
    const Box1 x = boxes.box(), y = boxes.box();
    expect_enclosed(f, std::array{Range{x.lo, x.hi}, Range{y.lo, y.hi}}, boxes);
    if (testing::Test::HasFatalFailure()) FAIL() << "seed " << seed;
  }
}

TEST(Domain, random_formulas_are_enclosed) { expect_random_formulas_enclosed(1500, false); }
TEST(Domain, random_formulas_with_elementary_functions_are_enclosed) {
  expect_random_formulas_enclosed(40, true);
}

// Over the whole domain its lower end is 0, and a kernel finds a little less: no lower end is taken for more
// than it is.
TEST(Domain, what_is_known_to_be_nonnegative_is_made_so) {
  const auto above_zero = [](Expr x) { return make(Op::exp, x) - 1.0; };
  const Formula formulas[] = {
      [&](Expr x, Expr y) { return above_zero(x) * above_zero(y); },
      [&](Expr x, Expr) { return make(Op::powi, above_zero(x), constant_like(x, 4)); },
      [&](Expr x, Expr y) { return sqrt(above_zero(x)) * y; },
  };
  for (const Formula& formula : formulas)
    for (const Type type : {f32, f64}) {
      const auto program = over_domain(program_of(formula), std::array{Range{0, 1}, Range{0, 1}}, type);
      const auto v =
          evaluate(*interpret(run_passes(*program, kernel_passes())), std::array{0.0, 0.0, 0.0, 0.0});
      EXPECT_TRUE(-v[0] <= 0 && 0 <= v[1]) << -v[0] << ' ' << v[1] << '\n' << to_text(program_of(formula));
    }
}

TEST(Domain, signs_known_over_it_save_ops) {
  const auto costs = [](const Formula& formula, Range x, Range y) {
    const Program f = program_of(formula);
    return std::pair(cost(*over_domain(f, std::array{everything, everything}, f32)),
                     cost(*over_domain(f, std::array{x, y}, f32)));
  };
  const Range above_one{2, 3}, around_zero{-1, 1};
  const auto product =
      costs([](Expr x, Expr y) { return (x * x + y * y) * (x - 1.0); }, above_one, around_zero);
  const auto quotient = costs([](Expr x, Expr y) { return y / (x - 1.0); }, above_one, around_zero);
  const auto root = costs([](Expr x, Expr) { return sqrt(x - 1.0); }, above_one, around_zero);
  const auto power = costs([](Expr x, Expr) { return make(Op::powi, x - 1.0, constant_like(x, 4)); },
                           above_one, around_zero);
  for (const auto& [without, with] : {product, quotient, root, power}) EXPECT_LT(with, without);
  EXPECT_LE(product.second + 8, product.first);

  // Nothing is paid for a sign that nobody asks for.
  const auto sum = costs([](Expr x, Expr y) { return 3.0 * (x + y) + y; }, above_one, above_one);
  EXPECT_EQ(sum.first, sum.second);
}

}  // namespace
}  // namespace imp::test
