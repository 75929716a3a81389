// compact, equality, and whether a Program rounds up.
#include "ir/program.h"

#include <gtest/gtest.h>

#include "ir/loop.h"
#include "ir/text.h"
#include "tests/support/make.h"
#include "tests/support/random_program.h"

namespace imp {
namespace {

using test::input;
using test::number;
using test::output;

Program march(int order) {
  Program p;
  p.name = "march";
  Expr x, r;
  x = input(p, "x");
  r = input(p, "r", f32, Rate::frame);
  Expr a = order == 0 ? x * x : r * r;  // the same Program, built in two orders
  Expr b = order == 0 ? r * r : x * x;
  if (order != 0) std::swap(a, b);
  if (order != 0) (a * 7.0) / b;  // dead
  Loop loop(p, "go", 9);
  const Expr t = loop.state("t", order == 0 ? a + b : b + a);
  loop.next(t, t + 0.5);
  loop.again_while(t < 10.0);
  output(p, "t", loop.result(t));
  return p;
}

TEST(Program, is_equal_up_to_dead_nodes_and_numbering) {
  EXPECT_TRUE(march(0) == march(1));
  EXPECT_FALSE(march(0) != march(1));
  EXPECT_EQ(to_text(march(0)), to_text(march(1)));
  EXPECT_EQ(to_text(march(0)), to_text(march(1)));
}

TEST(Program, differs_by_everything_that_can_be_told_from_outside) {
  const auto differs = [](auto&& change) {
    Program p = march(0);
    change(p);
    return p != march(0);
  };
  EXPECT_TRUE(differs([](Program& p) { p.name = "other"; }));
  EXPECT_TRUE(differs([](Program& p) { p.inputs[0].name = "y"; }));
  EXPECT_TRUE(differs([](Program& p) { p.inputs[0].rate = Rate::cell; }));
  EXPECT_TRUE(differs([](Program& p) { p.outputs[0].name = "u"; }));
  EXPECT_TRUE(differs([](Program& p) { p.outputs[0].id = p.inputs[0].id; }));
  EXPECT_TRUE(differs([](Program& p) { p.outputs.push_back({"more", p.inputs[0].id}); }));
  EXPECT_TRUE(differs([](Program& p) { p.phases[0].steps = 10; }));
  EXPECT_TRUE(differs([](Program& p) { p.phases[0].name = "g"; }));
  EXPECT_TRUE(differs([](Program& p) { p.phases[0].again = p.phases[0].enter; }));
  EXPECT_TRUE(differs([](Program& p) { p.phases[0].states[0].name = "u"; }));
  EXPECT_TRUE(differs([](Program& p) { p.phases[0].states[0].next = p.phases[0].states[0].id; }));
  EXPECT_TRUE(differs([](Program& p) { p.callees.push_back(std::make_shared<Program>(march(0))); }));
  EXPECT_TRUE(differs([](Program& p) { input(p, "more"); }));
  EXPECT_FALSE(differs([](Program& p) { number(p, 77); }));
  EXPECT_FALSE(differs([](Program& p) { p.graph.set_name(p.outputs[0].id, "name"); }));
}

TEST(Program, compact_drops_dead_nodes_states_and_phases_but_no_inputs) {
  Program p;
  const Expr x = input(p, "x"), unused = input(p, "unused");
  Loop dead(p, "dead", 3);
  dead.state("d", x);
  Loop loop(p, "live", 3);
  const Expr a = loop.state("a", x), b = loop.state("b", x), c = loop.state("c", x);
  loop.next(a, a + b);
  loop.next(b, b * 2.0);
  loop.next(c, c * 3.0);
  output(p, "a", loop.result(a));
  const Program q = compact(p);
  ASSERT_EQ(q.phases.size(), 1u);
  EXPECT_EQ(q.phases[0].name, "live");
  ASSERT_EQ(q.phases[0].states.size(), 2u);  // b is needed by a
  EXPECT_EQ(q.phases[0].states[1].name, "b");
  ASSERT_EQ(q.inputs.size(), 2u);
  EXPECT_EQ(q.inputs[1].name, "unused");
  EXPECT_EQ(verify(q), "");
  EXPECT_TRUE(p == q);
  static_cast<void>(unused);
}

TEST(Program, compact_keeps_names_and_spans) {
  Program p;
  const Expr x = input(p, "x");
  x * 5.0;
  const Expr s = x * x;
  p.graph.set_name(s.id, "square");
  p.graph.set_span(s.id, {0, 1, 2});
  output(p, "s", s);
  const Program q = compact(p);
  EXPECT_EQ(q.graph.name(q.outputs[0].id), "square");
  EXPECT_EQ(q.graph.span(q.outputs[0].id), (Span{0, 1, 2}));
}

TEST(Program, compact_twice_is_compact_once) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Program p = test::random_program(
        seed, {.phases = seed % 3, .upward = seed % 2 == 0, .tables = true, .calls = true});
    const Program once = compact(p), twice = compact(once);
    ASSERT_EQ(verify(once), "") << "seed " << seed;
    EXPECT_TRUE(once == p) << "seed " << seed;
    EXPECT_EQ(to_text(twice), to_text(once)) << "seed " << seed;
    EXPECT_EQ(twice.graph.size(), once.graph.size()) << "seed " << seed;
  }
}

TEST(Program, rounds_up_with_any_upward_op_that_is_needed) {
  Program p;
  const Expr x = input(p, "x");
  output(p, "f", x + 1.0);
  EXPECT_FALSE(rounds_up(p));
  add_up(x, x);
  EXPECT_FALSE(rounds_up(p)) << "a dead op changes nothing";
  Program q = p;
  q.outputs.push_back({"g", add_up({&q.graph, x.id}, {&q.graph, x.id}).id});
  EXPECT_TRUE(rounds_up(q));
  p.callees.push_back(std::make_shared<Program>(q));
  EXPECT_TRUE(rounds_up(p)) << "the callee does";
}

TEST(Program, finds_inputs_and_outputs_by_name) {
  const Program p = march(0);
  EXPECT_EQ(p.input("r"), &p.inputs[1]);
  EXPECT_EQ(p.output("t"), &p.outputs[0]);
  EXPECT_EQ(p.input("t"), nullptr);
  EXPECT_EQ(p.output("r"), nullptr);
}

}  // namespace
}  // namespace imp
