// Loop builds a phase, with the defaults it promises.
#include "ir/loop.h"

#include <gtest/gtest.h>

#include "ir/verify.h"
#include "tests/support/make.h"

namespace imp {
namespace {

using test::input;
using test::output;

TEST(Loop, builds_a_phase) {
  Program p;
  const Expr x = input(p, "x");
  Loop loop(p, "march", 512);
  const Expr t = loop.state("t", x);
  const Truth found = loop.state("found", truth_of(p.graph, false));
  const Expr next = t + 1.0;
  loop.next(t, next);
  loop.next(found, t > 5.0);
  loop.enter_if(x > 0.0);
  loop.again_while(!found);
  output(p, "t", loop.result(t));
  output(p, "found", loop.result(found));

  ASSERT_EQ(verify(p), "");
  const Phase& phase = p.phases.at(0);
  EXPECT_EQ(phase.name, "march");
  EXPECT_EQ(phase.steps, 512u);
  EXPECT_EQ(phase.enter, (x > 0.0).id);
  EXPECT_EQ(phase.again, (!found).id);
  ASSERT_EQ(phase.states.size(), 2u);
  EXPECT_EQ(phase.states[0].name, "t");
  EXPECT_EQ(phase.states[0].type, f32);
  EXPECT_EQ(phase.states[0].init, x.id);
  EXPECT_EQ(phase.states[0].next, next.id);
  EXPECT_EQ(phase.states[1].type, truth);
  EXPECT_EQ(loop.result(t).id, phase.states[0].result);
}

TEST(Loop, by_default_every_lane_enters_and_goes_on_and_states_stay) {
  Program p;
  const Expr x = input(p, "x");
  Loop loop(p, "still", 3);
  const Expr t = loop.state("t", x);
  output(p, "t", loop.result(t));
  EXPECT_EQ(verify(p), "");
  EXPECT_EQ(p.graph.truth_value(p.phases[0].enter), true);
  EXPECT_EQ(p.graph.truth_value(p.phases[0].again), true);
  EXPECT_EQ(p.phases[0].states[0].next, t.id);
}

TEST(Loop, a_state_may_be_a_table) {
  Program p;
  const Expr x = input(p, "x");
  Loop loop(p, "stack", 3);
  const Expr stack = loop.state("stack", Expr{&p.graph, p.graph.fill(table_of(f32, 4), x.id)});
  loop.next(stack, make(Op::store, stack, x, x));
  output(p, "top", make(Op::load, loop.result(stack), x));
  EXPECT_EQ(verify(p), "");
  EXPECT_EQ(p.phases[0].states[0].type, table_of(f32, 4));
}

TEST(Loop, phases_come_one_after_the_other) {
  Program p;
  const Expr x = input(p, "x");
  Loop first(p, "first", 3);
  const Expr a = first.state("t", x);
  Loop second(p, "second", 3);
  const Expr b = second.state("t", first.result(a));
  output(p, "t", second.result(b));
  EXPECT_EQ(verify(p), "");
  EXPECT_NE(a.id, b.id);
}

}  // namespace
}  // namespace imp
