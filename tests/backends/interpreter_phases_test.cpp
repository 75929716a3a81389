// Phases, tables, calls and the trace of the reference.
#include <gtest/gtest.h>

#include "backends/interpreter/interpreter.h"
#include "ir/loop.h"
#include "ir/verify.h"
#include "tests/support/evaluate.h"
#include "tests/support/make.h"
#include "tests/support/random_program.h"
#include "tests/support/rays.h"

namespace imp {
namespace {

using test::evaluate;
using test::input;
using test::number;
using test::output;

// t counts from 0 while it is below `last`, if x is positive.
Program counter(std::uint32_t steps) {
  Program p;
  const Expr last = input(p, "last"), x = input(p, "x");
  Loop loop(p, "count", steps);
  const Expr t = loop.state("t", number(p, 0));
  loop.next(t, t + 1.0);
  loop.enter_if(x > 0.0);
  loop.again_while(t < last);
  output(p, "t", loop.result(t));
  return p;
}

TEST(InterpreterPhases, again_is_asked_of_the_states_before_the_step) {
  EXPECT_EQ(evaluate(counter(100), {3, 1})[0], 4);  // the step with t = 3 is made, and is the last
  EXPECT_EQ(evaluate(counter(100), {-1, 1})[0], 1);
  EXPECT_EQ(evaluate(counter(100), {NAN, 1})[0], 1);
}

TEST(InterpreterPhases, steps_are_bounded) {
  EXPECT_EQ(evaluate(counter(2), {10, 1})[0], 2);
  EXPECT_EQ(evaluate(counter(1), {10, 1})[0], 1);
}

TEST(InterpreterPhases, who_does_not_enter_keeps_the_start) {
  EXPECT_EQ(evaluate(counter(100), {10, 0})[0], 0);
}

TEST(InterpreterPhases, states_change_all_at_once) {
  Program p;
  const Expr x = input(p, "x"), y = input(p, "y");
  Loop loop(p, "swap", 3);
  const Expr a = loop.state("a", x), b = loop.state("b", y);
  loop.next(a, b);
  loop.next(b, a);
  output(p, "a", loop.result(a));
  output(p, "b", loop.result(b));
  EXPECT_EQ(evaluate(p, {1, 2}), (std::vector<double>{2, 1}));
}

TEST(InterpreterPhases, each_ray_goes_its_own_way) {
  const Program p = counter(100);
  test::Rays rays(p, 4);
  for (std::size_t i = 0; i < 4; ++i) rays.set(0, i, static_cast<double>(3 * i)), rays.set(1, i, i != 2);
  rays.run(*interpret(p));
  const double expected[] = {1, 4, 0, 10};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(rays.get(0, i), expected[i]) << i;
}

TEST(InterpreterPhases, the_second_sees_the_results_of_the_first) {
  Program p;
  const Expr x = input(p, "x");
  Loop first(p, "double", 3);
  const Expr a = first.state("a", x);
  first.next(a, a * 2.0);
  Loop second(p, "add", 4);
  const Expr b = second.state("b", first.result(a) + 1.0);
  second.next(b, b + first.result(a));
  output(p, "b", second.result(b) - x);
  EXPECT_EQ(evaluate(p, {1})[0], 8 + 1 + 4 * 8 - 1);
}

TEST(InterpreterTables, the_index_is_rounded_down_and_clamped_and_nan_is_zero) {
  for (const Type index : {f32, f64}) {
    Program p;
    const Id table = add_input(p, "table", table_of(f32, 4), Rate::cell);
    const Expr i = input(p, "i", index);
    p.outputs.push_back({"v", p.graph.add(Op::load, {table, i.id})});
    test::Rays rays(p, 1);
    rays.fill(0, 10);  // 10, 11, 12, 13
    const auto kernel = interpret(p);
    const std::pair<double, double> expected[] = {{0, 10},  {1, 11},         {1.99, 11},     {3, 13},
                                                  {4, 13},  {1e30, 13},      {INFINITY, 13}, {-0.5, 10},
                                                  {-7, 10}, {-INFINITY, 10}, {NAN, 10}};
    for (const auto& [at, value] : expected) {
      rays.set(1, 0, at);
      EXPECT_EQ(rays.run(*kernel).get(0, 0), value) << at;
    }
  }
}

TEST(InterpreterTables, a_store_makes_another_table) {
  Program p;
  const Expr i = input(p, "i"), j = input(p, "j");
  const Id filled = p.graph.fill(table_of(f64, 3), p.graph.constant(f64, 7));
  const Id stored = p.graph.add(Op::store, {filled, i.id, p.graph.constant(f64, 0.5)});
  p.outputs.push_back({"before", p.graph.add(Op::load, {filled, j.id})});
  p.outputs.push_back({"after", p.graph.add(Op::load, {stored, j.id})});
  EXPECT_EQ(evaluate(p, {1, 1}), (std::vector<double>{7, 0.5}));
  EXPECT_EQ(evaluate(p, {1, 2}), (std::vector<double>{7, 7}));
  EXPECT_EQ(evaluate(p, {9, 2}), (std::vector<double>{7, 0.5}));
}

// Pushes the numbers from n down to 1, then takes the top two off.
TEST(InterpreterTables, a_stack_in_a_phase) {
  Program p;
  const Expr n = input(p, "n");
  const Expr empty{&p.graph, p.graph.fill(table_of(f32, 8), p.graph.constant(f32, 0))};
  Loop loop(p, "push", 20);
  const Expr stack = loop.state("stack", empty), depth = loop.state("depth", number(p, 0)),
             k = loop.state("k", n);
  loop.next(stack, make(Op::store, stack, depth, k));
  loop.next(depth, depth + 1.0);
  loop.next(k, k - 1.0);
  loop.again_while(k > 1.0);
  output(p, "top", make(Op::load, loop.result(stack), loop.result(depth) - 1.0));
  output(p, "below", make(Op::load, loop.result(stack), loop.result(depth) - 2.0));
  output(p, "bottom", make(Op::load, loop.result(stack), number(p, 0)));
  EXPECT_EQ(evaluate(p, {5}), (std::vector<double>{1, 2, 5}));
  EXPECT_EQ(evaluate(p, {7}), (std::vector<double>{1, 2, 7}));
}

TEST(InterpreterTables, two_tables_of_a_phase_change_places) {
  Program p;
  const Expr x = input(p, "x"), y = input(p, "y");
  Loop loop(p, "swap", 1);
  const Expr a = loop.state("a", Expr{&p.graph, p.graph.fill(table_of(f32, 3), x.id)});
  const Expr b = loop.state("b", Expr{&p.graph, p.graph.fill(table_of(f32, 3), y.id)});
  loop.next(a, b);
  loop.next(b, a);
  output(p, "a", make(Op::load, loop.result(a), x));
  output(p, "b", make(Op::load, loop.result(b), x));
  EXPECT_EQ(evaluate(p, {1, 2}), (std::vector<double>{2, 1}));
}

TEST(InterpreterCalls, run_the_callee_with_its_phases_for_each_ray_and_step) {
  auto inner = std::make_shared<Program>(counter(100));
  inner->name = "counter";
  Program p;
  p.callees = {inner};
  const Expr n = input(p, "n");
  Loop loop(p, "outer", 3);
  const Expr sum = loop.state("sum", number(p, 0)), k = loop.state("k", n);
  const Expr count{&p.graph, p.graph.call(f32, 0, 0, std::array{k.id, one(k).id})};
  loop.next(sum, sum + count);
  loop.next(k, k + 1.0);
  output(p, "sum", loop.result(sum));
  ASSERT_EQ(verify(p), "");
  EXPECT_EQ(evaluate(p, {1})[0], 2 + 3 + 4);
  EXPECT_EQ(evaluate(p, {5})[0], 6 + 7 + 8);
}

TEST(InterpreterCalls, have_many_outputs_and_take_tables) {
  auto inner = std::make_shared<Program>();
  const Id table = add_input(*inner, "table", table_of(f32, 4), Rate::cell);
  const Expr i = input(*inner, "i", f64);
  inner->outputs.push_back({"entry", inner->graph.add(Op::load, {table, i.id})});
  output(*inner, "low", i < 2.0);
  Program p;
  p.callees = {inner};
  const Id outer = add_input(p, "outer", table_of(f32, 4), Rate::frame);
  const Expr j = input(p, "j", f64);
  p.outputs.push_back({"low", p.graph.call(truth, 0, 1, std::array{outer, j.id})});
  p.outputs.push_back({"entry", p.graph.call(f32, 0, 0, std::array{outer, j.id})});
  ASSERT_EQ(verify(p), "");
  test::Rays rays(p, 2);
  rays.fill(0, 5);
  rays.set(1, 0, 1);
  rays.set(1, 1, 3);
  rays.run(*interpret(p));
  EXPECT_EQ(rays.get(0, 0), 1);
  EXPECT_EQ(rays.get(1, 0), 6);
  EXPECT_EQ(rays.get(0, 1), 0);
  EXPECT_EQ(rays.get(1, 1), 8);
}

TEST(InterpreterTrace, shows_the_states_before_each_step_and_at_the_end) {
  std::vector<TraceStep> seen;
  Program p = counter(100);
  const auto kernel = interpret(p, [&](const TraceStep& step) { seen.push_back(step); });
  test::Rays rays(p, 2);
  rays.set(0, 0, 1);
  rays.set(1, 0, 1);
  rays.set(1, 1, -1);  // does not enter
  rays.run(*kernel);
  ASSERT_EQ(seen.size(), 4u);
  for (std::uint32_t i = 0; i < 3; ++i) {
    EXPECT_EQ(seen[i].ray, 0u);
    EXPECT_EQ(seen[i].phase, 0u);
    EXPECT_EQ(seen[i].step, i);
    EXPECT_EQ(seen[i].again, i < 2);
    EXPECT_EQ(seen[i].states, (std::vector<double>{static_cast<double>(i)}));
  }
  EXPECT_EQ(seen[3].ray, 1u);
  EXPECT_EQ(seen[3].step, 0u);
  EXPECT_FALSE(seen[3].again);
}

TEST(InterpreterTrace, has_truths_as_numbers_and_tables_whole) {
  Program p;
  const Expr x = input(p, "x");
  Loop loop(p, "go", 1);
  const Expr table = loop.state("table", Expr{&p.graph, p.graph.fill(table_of(f32, 2), x.id)});
  const Truth flag = loop.state("flag", truth_of(p.graph, true));
  loop.next(table, make(Op::store, table, x, number(p, 9)));
  loop.next(flag, !flag);
  output(p, "flag", loop.result(flag));
  std::vector<std::vector<double>> seen;
  const auto kernel = interpret(p, [&](const TraceStep& step) { seen.push_back(step.states); });
  evaluate(*kernel, std::array{1.0});
  EXPECT_EQ(seen, (std::vector<std::vector<double>>{{1, 1, 1}, {1, 9, 0}}));
}

// What compact changes is not the value.
TEST(InterpreterPrograms, compact_keeps_every_bit) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const Program p = test::random_program(seed, {.nodes = 40,
                                                  .phases = seed % 3,
                                                  .upward = seed % 2 == 0,
                                                  .tables = true,
                                                  .calls = true,
                                                  .packets = true});
    const auto differs = [seed](const Program& q) {
      const Program small = compact(q);
      test::Rays a(q, 4), b(small, 4);
      test::Random random(seed);
      for (std::size_t i = 0; i < q.inputs.size(); ++i) {
        const double value = random.between(-4, 4);
        a.fill(i, value), b.fill(i, value);
      }
      a.run(*interpret(q)), b.run(*interpret(small));
      for (std::size_t i = 0; i < q.outputs.size(); ++i)
        for (std::size_t ray = 0; ray < 4; ++ray)
          if (!test::same_bits(a.get(i, ray), b.get(i, ray))) return true;
      return false;
    };
    EXPECT_FALSE(differs(p)) << "seed " << seed;
  }
}

}  // namespace
}  // namespace imp
