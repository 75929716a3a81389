// Rebuilding Programs: everything is carried over.
#include "passes/rewrite.h"

#include <gtest/gtest.h>

#include "ir/loop.h"
#include "ir/verify.h"

namespace imp {
namespace {

Program with_everything() {
  auto callee = std::make_shared<Program>();
  callee->name = "twice";
  const Expr a{&callee->graph, add_input(*callee, "a", f64, Rate::ray)};
  callee->outputs = {{"b", (a + a).id}};

  Program p;
  p.name = "all";
  p.callees.push_back(callee);
  const Expr x{&p.graph, add_input(p, "x", f64, Rate::ray)};
  const Id table = add_input(p, "table", table_of(f64, 4), Rate::frame);
  const Expr entry{&p.graph, p.graph.add(Op::load, {table, x.id})};
  const Expr called{&p.graph, p.graph.call(f64, 0, 0, std::array{entry.id})};
  Loop loop(p, "march", 10);
  const Expr t = loop.state("t", called);
  const Truth found = loop.state("found", truth_of(p.graph, false));
  loop.next(t, t + x * 0.1);
  loop.next(found, t > 3.0);
  loop.enter_if(x > 0.0);
  loop.again_while(!found);
  p.outputs = {{"t", loop.result(t).id}, {"found", loop.result(found).id}};
  return p;
}

TEST(Rewrite, copying_changes_nothing) {
  const Program p = with_everything();
  ASSERT_EQ(verify(p), "");
  const Program q = rewrite(p, [](Graph& graph, Id, const Node& node) { return copy(graph, node); });
  EXPECT_EQ(verify(q), "");
  EXPECT_TRUE(q == p);
}

TEST(Rewrite, types_change_everywhere) {
  const auto to_float = [](Type t) { return t.scalar == Scalar::f64 ? Type{Scalar::f32, t.length} : t; };
  Program p = with_everything();
  p.callees.clear();
  p.outputs.resize(1);
  const Program q = rewrite(
      p,
      [](Graph& graph, Id, const Node& node) {
        if (node.op == Op::call) return node.args[0];
        if (node.op != Op::constant || node.type.is_truth()) return copy(graph, node);
        return graph.constant(node.type, std::bit_cast<double>(node.payload));
      },
      to_float);
  EXPECT_EQ(verify(q), "");
  EXPECT_EQ(q.inputs[0].type, f32);
  EXPECT_EQ(q.inputs[1].type, table_of(f32, 4));
  EXPECT_EQ(q.phases[0].states[0].type, f32);
  EXPECT_EQ(q.phases[0].states[1].type, truth);
  EXPECT_EQ(q.graph[q.outputs[0].id].type, f32);
}

TEST(Rewrite, spans_and_names_go_to_the_replacement) {
  Program p;
  const Expr x{&p.graph, add_input(p, "x", f64, Rate::ray)};
  const Expr y = abs(x);
  p.graph.set_span(y.id, {0, 3, 9});
  p.graph.set_name(y.id, "size");
  p.outputs = {{"f", y.id}};
  const Program q = rewrite(p, [](Graph& graph, Id, const Node& node) {
    return node.op == Op::abs ? graph.add(Op::sqrt, node.args) : copy(graph, node);
  });
  const Id id = q.outputs[0].id;
  EXPECT_EQ(q.graph[id].op, Op::sqrt);
  EXPECT_EQ(q.graph.span(id), (Span{0, 3, 9}));
  EXPECT_EQ(q.graph.name(id), "size");
}

TEST(Rewrite, a_name_is_not_given_to_an_input) {
  Program p;
  const Expr x{&p.graph, add_input(p, "x", f64, Rate::ray)};
  const Expr y = abs(x);
  p.graph.set_name(y.id, "size");
  p.outputs = {{"f", y.id}};
  const Program q = rewrite(p, [](Graph& graph, Id, const Node& node) {
    return node.op == Op::abs ? node.args[0] : copy(graph, node);
  });
  EXPECT_EQ(q.graph.name(q.outputs[0].id), "");
}

TEST(Rewrite, dead_nodes_stay_behind) {
  Program p;
  const Expr x{&p.graph, add_input(p, "x", f64, Rate::ray)};
  abs(sqrt(x));
  p.outputs = {{"f", (x + 1.0).id}};
  const Program q = rewrite(p, [](Graph& graph, Id, const Node& node) { return copy(graph, node); });
  EXPECT_EQ(q.graph.size(), 3u);
}

}  // namespace
}  // namespace imp
