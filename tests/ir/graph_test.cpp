// Hash-consing: equal nodes have equal ids.
#include "ir/graph.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/make.h"

namespace imp {
namespace {

using test::input;

TEST(Graph, equal_nodes_have_equal_ids) {
  Program p;
  const Expr x = input(p, "x"), y = input(p, "y");
  EXPECT_EQ((x - y).id, (x - y).id);
  EXPECT_NE((x - y).id, (y - x).id);
  EXPECT_EQ(sqrt(x * y).id, sqrt(x * y).id);
  EXPECT_NE((x * y).id, make(Op::mul_up, x, y).id);
}

TEST(Graph, operands_commute_where_no_bit_depends_on_their_order) {
  Program p;
  const Expr x = input(p, "x"), y = input(p, "y");
  for (int i = 0; i < op_count; ++i) {
    const Op op = static_cast<Op>(i);
    const OpKind kind = info(op).kind;
    if (info(op).arity != 2 || kind == OpKind::structure) continue;
    const Id a = kind == OpKind::logic ? (x < y).id : x.id, b = kind == OpKind::logic ? (y < x).id : y.id;
    if (takes_integers(op)) continue;
    EXPECT_EQ(p.graph.add(op, {a, b}) == p.graph.add(op, {b, a}), commutes(op)) << info(op).name;
  }
  EXPECT_FALSE(commutes(Op::min));  // NaN, and zeros of two signs
  EXPECT_FALSE(commutes(Op::max));
}

TEST(Graph, operands_come_before_users) {
  Program p;
  const Expr x = input(p, "x");
  (x * x + 1.0) / (x - 3.0);
  for (std::uint32_t i = 0; i < p.graph.size(); ++i)
    for (const Id arg : p.graph[Id{i}].args) EXPECT_LT(arg.index, i);
}

TEST(Graph, constants_differ_by_type_and_by_the_sign_of_zero) {
  Graph g;
  EXPECT_NE(g.constant(f32, 1), g.constant(f64, 1));
  EXPECT_NE(g.constant(f32, 0.0), g.constant(f32, -0.0));
  EXPECT_NE(g.constant(true), g.constant(f32, 1));
  EXPECT_EQ(g.constant(f64, NAN), g.constant(f64, -std::numeric_limits<double>::signaling_NaN()));
  EXPECT_EQ(g.constant(f32, 0.1), g.constant(f32, 0.1f));
}

TEST(Graph, constants_can_be_asked_for_their_value) {
  Graph g;
  EXPECT_EQ(g.number(g.constant(f32, 0.1)), 0.1f);
  EXPECT_EQ(g.number(g.constant(f64, 0.1)), 0.1);
  EXPECT_EQ(g.number(g.constant(true)), std::nullopt);
  EXPECT_EQ(g.truth_value(g.constant(true)), true);
  EXPECT_EQ(g.truth_value(g.constant(f32, 1)), std::nullopt);
  EXPECT_TRUE(g.is_number(g.constant(f32, -0.0), -0.0));
  EXPECT_FALSE(g.is_number(g.constant(f32, -0.0), 0.0));
}

TEST(Graph, the_first_name_and_span_stay_and_take_no_part_in_equality) {
  Program p;
  const Expr x = input(p, "x");
  const Id id = (x * x).id;
  p.graph.set_name(id, "square");
  p.graph.set_name(id, "again");
  p.graph.set_span(id, {0, 3, 5});
  p.graph.set_span(id, {0, 7, 9});
  EXPECT_EQ(p.graph.name(id), "square");
  EXPECT_EQ(p.graph.span(id), (Span{0, 3, 5}));
  EXPECT_EQ((x * x).id, id);
  EXPECT_EQ(p.graph.name(x.id), "");
  EXPECT_FALSE(p.graph.span(x.id).valid());
}

TEST(Graph, types_follow_from_the_operands) {
  const Type t = table_of(f64, 4);
  EXPECT_EQ(type_of(Op::add, std::array{f32, f32}), f32);
  EXPECT_EQ(type_of(Op::add, std::array{f32, f64}), std::nullopt);
  EXPECT_EQ(type_of(Op::add, std::array{truth, truth}), std::nullopt);
  EXPECT_EQ(type_of(Op::add, std::array{f32}), std::nullopt);
  EXPECT_EQ(type_of(Op::lt, std::array{f64, f64}), truth);
  EXPECT_EQ(type_of(Op::and_, std::array{truth, truth}), truth);
  EXPECT_EQ(type_of(Op::and_, std::array{truth, f32}), std::nullopt);
  EXPECT_EQ(type_of(Op::select, std::array{truth, f64, f64}), f64);
  EXPECT_EQ(type_of(Op::select, std::array{f64, f64, f64}), std::nullopt);
  EXPECT_EQ(type_of(Op::widen, std::array{f32}), f64);
  EXPECT_EQ(type_of(Op::widen, std::array{f64}), std::nullopt);
  EXPECT_EQ(type_of(Op::narrow_up, std::array{f64}), f32);
  EXPECT_EQ(type_of(Op::load, std::array{t, f32}), f64);
  EXPECT_EQ(type_of(Op::load, std::array{f64, f32}), std::nullopt);
  EXPECT_EQ(type_of(Op::store, std::array{t, f32, f64}), t);
  EXPECT_EQ(type_of(Op::store, std::array{t, f32, f32}), std::nullopt);
}

TEST(Type, text_goes_both_ways) {
  for (const Type t : {truth, f32, f64, table_of(f32, 1), table_of(f64, 4294967295u)})
    EXPECT_EQ(type_named(to_text(t)), t);
  for (const char* wrong :
       {"", "f16", "f32[", "f32[]", "f32]", "f32[0]", "f32[-1]", "f32[4294967296]", "f32[1", "[", "]", "[3]"})
    EXPECT_EQ(type_named(wrong), std::nullopt) << wrong;
}

}  // namespace
}  // namespace imp
