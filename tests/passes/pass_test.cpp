// Running passes: order, times, text, and what a Program calls.
#include "passes/pass.h"

#include <gtest/gtest.h>

#include <sstream>

#include "ir/expr.h"
#include "ir/verify.h"
#include "passes/canonicalize.h"
#include "passes/power.h"

namespace imp {
namespace {

Program cube() {
  Program p;
  p.name = "cube";
  const Expr x{&p.graph, add_input(p, "x", f64, Rate::ray)};
  p.outputs = {{"f", make(Op::powi, x, constant_like(x, 3)).id}};
  return p;
}

bool has(const Program& p, Op op) {
  for (std::uint32_t i = 0; i < p.graph.size(); ++i)
    if (p.graph[Id{i}].op == op) return true;
  return false;
}

constexpr Pass two_passes[] = {{"powers", Preserves::bits, reduce_powers},
                               {"canonicalize", Preserves::bits, canonicalize}};

TEST(Pass, tells_what_it_did) {
  std::ostringstream text;
  PassTrace trace;
  trace.text = &text;
  run_passes(cube(), two_passes, &trace);
  ASSERT_EQ(trace.times.size(), 2u);
  EXPECT_EQ(trace.times[0].name, "powers");
  EXPECT_TRUE(trace.times[0].changed);
  EXPECT_EQ(trace.times[0].nodes_before, 3u);
  EXPECT_EQ(trace.times[0].nodes_after, 3u + 1u);  // x, the exponent, x^2, x^3
  EXPECT_GE(trace.times[0].time.count(), 0);
  EXPECT_FALSE(trace.times[1].changed);
  EXPECT_TRUE(text.str().starts_with("== powers\n")) << text.str();
  EXPECT_FALSE(text.str().contains("== canonicalize")) << text.str();
}

TEST(Pass, prints_only_what_was_asked_for) {
  std::ostringstream text;
  PassTrace trace;
  trace.text = &text;
  trace.print_after = "canonicalize";
  run_passes(cube(), two_passes, &trace);
  EXPECT_TRUE(text.str().starts_with("== canonicalize\n")) << text.str();  // though it changed nothing
  EXPECT_FALSE(text.str().contains("== powers")) << text.str();
}

TEST(Pass, kernels_have_no_powers_and_no_dead_code) {
  const Program p = run_passes(cube(), kernel_passes());
  EXPECT_EQ(p.graph.size(), 3u);  // x, x^2, x^3
  EXPECT_FALSE(has(p, Op::powi));
}

TEST(Pass, callees_go_through_it_too_and_stay_shared) {
  const auto inner = std::make_shared<const Program>(cube());
  auto outer = std::make_shared<Program>();
  outer->name = "outer";
  outer->callees.push_back(inner);
  const Id a = add_input(*outer, "a", f64, Rate::ray);
  outer->outputs = {{"f", outer->graph.call(f64, 0, 0, std::array{a})}};

  Program p;
  p.name = "main";
  p.callees = {inner, outer};
  const Id x = add_input(p, "x", f64, Rate::ray);
  p.outputs = {{"f", p.graph.call(f64, 0, 0, std::array{x})}, {"g", p.graph.call(f64, 1, 0, std::array{x})}};
  ASSERT_EQ(verify(p), "");

  const Program q = run_passes(p, kernel_passes());
  EXPECT_EQ(verify(q), "");
  EXPECT_FALSE(has(*q.callees[0], Op::powi));
  EXPECT_EQ(q.callees[0], q.callees[1]->callees[0]);
}

}  // namespace
}  // namespace imp
