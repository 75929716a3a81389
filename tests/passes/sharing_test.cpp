// What f, its derivatives and their enclosures have in common is computed once.
#include <gtest/gtest.h>

#include <algorithm>

#include "passes/differentiate.h"
#include "passes/extend/forms.h"
#include "passes/pass.h"
#include "tests/support/catalogue.h"
#include "tests/support/cost.h"
#include "tests/support/make.h"

namespace imp::test {
namespace {

Program gradient_of(const Program& f) {
  Diagnostics diagnostics;
  auto result = gradient(f, diagnostics);
  EXPECT_TRUE(result) << to_text(diagnostics);
  return *std::move(result);
}

std::size_t kernel_cost(const Program& f) { return cost(run_passes(f, kernel_passes())); }

std::size_t enclosure_cost(const Program& f) {
  Diagnostics diagnostics;
  auto result = extension(f, interval_form, f32, diagnostics);
  EXPECT_TRUE(result) << to_text(diagnostics);
  return kernel_cost(*std::move(result));
}

// All outputs in one graph, and the sum of one graph each.
template <class Cost>
std::pair<std::size_t, std::size_t> together_and_apart(const Program& f, Cost cost_of) {
  std::size_t apart = 0;
  for (const Output& output : f.outputs) {
    Program one = f;
    one.outputs = {output};
    apart += cost_of(compact(one));
  }
  return {cost_of(f), apart};
}

TEST(Sharing, gradients_and_their_enclosures_share_what_f_is_made_of) {
  for (const char* name : {"random_quintic", "barth_sextic"}) {
    const Program f = gradient_of(model_of(entry_named(name)).surfaces[0].f);
    const auto [values, values_apart] = together_and_apart(f, kernel_cost);
    const auto [bounds, bounds_apart] = together_and_apart(f, enclosure_cost);
    EXPECT_LT(10 * values, 8 * values_apart) << name;
    EXPECT_LT(10 * bounds, 8 * bounds_apart) << name;
  }
}

TEST(Sharing, sine_and_cosine_share_their_range_reduction) {
  Program f{.name = "f"};
  const Expr x = input(f, "x", f64);
  output(f, "sine", make(Op::sin, x));
  output(f, "cosine", make(Op::cos, x));
  const auto [values, values_apart] = together_and_apart(f, kernel_cost);
  const auto [bounds, bounds_apart] = together_and_apart(f, enclosure_cost);
  EXPECT_LT(10 * values, 8 * values_apart);
  EXPECT_LT(10 * bounds, 8 * bounds_apart);
}

// Products with 0 or 1 and sums with 0.
std::size_t idle_ops(const Program& program) {
  const Program live = compact(program);
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < live.graph.size(); ++i) {
    const Node node = live.graph[Id{i}];
    const auto has = [&](double value) {
      return std::ranges::any_of(node.args, [&](Id arg) { return live.graph.is_number(arg, value); });
    };
    const bool is_sum = node.op == Op::add || node.op == Op::sub, is_product = node.op == Op::mul;
    count += ((is_sum || is_product) && has(0)) || (is_product && has(1));
  }
  return count;
}

// But for what the author wrote: x - 0.
TEST(Sharing, derivatives_hold_no_idle_ops) {
  for (const SurfaceEntry& entry : catalogue()) {
    const Program f = model_of(entry).surfaces[0].f;
    EXPECT_EQ(idle_ops(gradient_of(f)), idle_ops(f)) << entry.id;
  }
}

}  // namespace
}  // namespace imp::test
