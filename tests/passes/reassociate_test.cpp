// Reassociation: how deep trees are, what stays together, what is computed less often.
#include "passes/reassociate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <ranges>

#include "ir/regions.h"
#include "ir/text.h"
#include "tests/support/cost.h"
#include "tests/support/make.h"

namespace imp {
namespace {

// How many ops wait for each other on the way to the first output.
std::size_t depth(const Program& program) {
  std::vector<std::size_t> depths;
  for (std::uint32_t i = 0; i < program.graph.size(); ++i) {
    const Node node = program.graph[Id{i}];
    std::size_t below = 0;
    for (const Id arg : node.args) below = std::max(below, depths[arg.index]);
    depths.push_back(below + (info(node.op).kind == OpKind::structure ? 0 : 1));
  }
  return depths[program.outputs[0].id.index];
}

Program with_inputs(std::size_t count) {
  Program result;
  for (std::size_t i = 0; i < count; ++i) add_input(result, "x" + std::to_string(i), f64, Rate::ray);
  return result;
}
Expr x(Program& program, std::size_t i) { return {&program.graph, program.inputs[i].id}; }

TEST(Reassociate, makes_trees_of_chains) {
  for (const std::size_t count : {2u, 3u, 4u, 5u, 8u, 9u, 64u, 1000u}) {
    Program p = with_inputs(count), q = p;
    Expr sum = x(p, 0), product = x(q, 0);
    for (std::size_t i = 1; i < count; ++i) {
      sum = i % 3 == 0 ? x(p, i) - sum : sum - x(p, i);
      product = product * x(q, i);
    }
    test::output(p, "f", sum);
    test::output(q, "f", product);
    for (const Program* each : {&p, &q}) {
      const Program tree = reassociate(*each);
      const std::size_t signs =
          each == &p && depth(tree) > static_cast<std::size_t>(std::bit_width(count - 1));
      EXPECT_EQ(depth(tree), static_cast<std::size_t>(std::bit_width(count - 1)) + signs) << to_text(tree);
      EXPECT_EQ(test::cost(tree), count - 1 + signs);
    }
  }
}

TEST(Reassociate, takes_nothing_apart_that_is_shared) {
  Program p = with_inputs(5);
  const Expr prefix = x(p, 0) + x(p, 1) + x(p, 2);
  test::output(p, "f", prefix + x(p, 3) + x(p, 4));
  test::output(p, "g", prefix * x(p, 3));
  EXPECT_TRUE(test::cost(reassociate(p)) == test::cost(p));
  EXPECT_TRUE(compact(reassociate(p)).output("g") != nullptr);

  Program q = with_inputs(3);  // squares are products too
  test::output(q, "f", x(q, 0) * x(q, 0) * x(q, 1) * x(q, 2));
  const Program squares = reassociate(q);
  EXPECT_TRUE(std::ranges::any_of(std::views::iota(0u, squares.graph.size()), [&](std::size_t i) {
    const Node node = squares.graph[Id{static_cast<std::uint32_t>(i)}];
    return node.op == Op::mul && node.args[0] == node.args[1];
  })) << to_text(squares);
}

TEST(Reassociate, leaves_upward_ops_alone) {
  Program p = with_inputs(4);
  test::output(p, "f", add_up(add_up(add_up(x(p, 0), x(p, 1)), x(p, 2)), x(p, 3)));
  test::output(p, "g", mul_up(mul_up(mul_up(x(p, 0), x(p, 1)), x(p, 2)), x(p, 3)));
  EXPECT_TRUE(reassociate(p) == p);
}

TEST(Reassociate, computes_first_what_changes_less_often) {
  Program p;
  const Expr a = test::input(p, "a", f64, Rate::frame), b = test::input(p, "b", f64, Rate::frame),
             y = test::input(p, "y", f64), z = test::input(p, "z", f64);
  test::output(p, "f", a + y + b + z);
  test::output(p, "g", y * a * b);
  const Program q = compact(reassociate(p));
  const auto region = regions(q);
  std::size_t per_ray = 0;
  for (std::uint32_t i = 0; i < q.graph.size(); ++i)
    per_ray += q.graph[Id{i}].op != Op::input && region[i] == Region::of(Rate::ray);
  EXPECT_EQ(per_ray, 3u) << to_text(q);
}

}  // namespace
}  // namespace imp
