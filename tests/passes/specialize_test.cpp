// What is decided over a domain is gone, and the value within it stays.
#include "passes/specialize.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "ir/text.h"
#include "ir/verify.h"
#include "tests/support/boxes.h"
#include "tests/support/composer.h"
#include "tests/support/cost.h"
#include "tests/support/exact.h"
#include "tests/support/formula.h"

namespace imp::test {
namespace {

struct Example {
  Formula formula, expected;
  Range x, y;
};

void expect_becomes(std::initializer_list<Example> examples) {
  for (const Example& each : examples) {
    const Program f = program_of(each.formula);
    EXPECT_EQ(to_text(specialize(f, std::array{each.x, each.y})), to_text(compact(program_of(each.expected))))
        << to_text(f);
  }
}

Expr first(Expr x, Expr) { return x; }
Expr second(Expr, Expr y) { return y; }
Expr three(Expr x, Expr) { return constant_like(x, 3); }

TEST(Specialize, abs) {
  const Formula f = [](Expr x, Expr) { return abs(x); };
  expect_becomes({{f, first, {0, 1}, {0, 1}},
                  {f, [](Expr x, Expr) { return -x; }, {-2, 0}, {0, 1}},
                  {f, f, {-1e-9, 1}, {0, 1}}});
}

TEST(Specialize, max_and_min) {
  const Formula larger = [](Expr x, Expr y) { return max(x, y); },
                smaller = [](Expr x, Expr y) { return min(x, y); };
  expect_becomes({{larger, first, {1, 2}, {0, 1}},
                  {larger, second, {-1, 0}, {0, 1}},
                  {larger, larger, {0, 1}, {0, 1}},
                  {smaller, second, {1, 2}, {0, 1}},
                  {smaller, first, {-1, 0}, {0, 1}},
                  {smaller, smaller, {0, 1}, {0, 1}}});
}

TEST(Specialize, choices) {
  const auto choice = [](Truth c, Expr x) { return select(c, x, constant_like(x, 3)); };
  expect_becomes({{[&](Expr x, Expr y) { return choice(x < y, x); }, first, {0, 1}, {2, 3}},
                  {[&](Expr x, Expr y) { return choice(x < y, x); }, three, {2, 3}, {0, 1}},
                  {[&](Expr x, Expr y) { return choice(x <= y && !equal(x, y), x); }, first, {0, 1}, {2, 3}},
                  {[&](Expr x, Expr y) { return choice(x < 5 || y < x, x); }, first, {0, 1}, {0, 1}}});
}

TEST(Specialize, what_has_one_value) {
  expect_becomes(
      {{[](Expr x, Expr y) { return make(Op::sign, x) * 3.0 + floor(y); }, three, {1, 2}, {0.1, 0.9}}});
}

// sqrt(x) may be undefined: max answers y then, and a comparison does not hold.
TEST(Specialize, nothing_where_a_value_may_be_missing) {
  const Formula larger = [](Expr x, Expr y) { return max(sqrt(x), y); };
  const Formula below = [](Expr x, Expr y) { return select(sqrt(x) < y, y, -y); };
  const Formula one_value = [](Expr x, Expr) { return make(Op::sign, sqrt(x) + 1.0); };
  expect_becomes({{larger, larger, {-1, 1}, {-3, -2}},
                  {larger, second, {-1, 1}, {2, 3}},
                  {below, below, {-1, 1}, {2, 3}},
                  {below, [](Expr, Expr y) { return -y; }, {-1, 1}, {-3, -2}},
                  {one_value, one_value, {-1, 1}, {0, 0}}});
}

TEST(Specialize, keeps_the_value_within_the_domain) {
  std::size_t simpler = 0;
  constexpr std::uint64_t count = 1500;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    const Program f =
        program_of([&](Expr x, Expr y) { return Composer(x, y, seed, seed % 3 == 0).formula(4); });
    Boxes boxes(seed);
    const Box1 x = boxes.box(), y = boxes.box();
    const Program special = specialize(f, std::array{Range{x.lo, x.hi}, Range{y.lo, y.hi}});
    ASSERT_EQ(verify(special), "");
    simpler += cost(special) < cost(f);
    for (int i = 0; i < 4; ++i) {
      const std::array at{boxes.inside(x), boxes.inside(y)};
      const Enclosure before = exact_values(f, at)[0], after = exact_values(special, at)[0];
      if (before.lo > before.hi) continue;  // undefined, or made of what is
      ASSERT_TRUE(after.lo <= after.hi && before.lo <= after.hi && after.lo <= before.hi)
          << fmt::format("seed {} at {}, {}: {} and {}\n", seed, at[0], at[1], before.nearest, after.nearest)
          << to_text(f) << to_text(special);
    }
  }
  EXPECT_GT(simpler, count / 4);
}

}  // namespace
}  // namespace imp::test
