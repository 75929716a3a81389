// From mathematics to numbers of one type.
#include "passes/precision.h"

#include <gtest/gtest.h>

#include "ir/loop.h"
#include "ir/text.h"
#include "ir/verify.h"
#include "tests/support/evaluate.h"

namespace imp {
namespace {

using test::evaluate;

// A formula of x under construction.
struct BuiltFormula {
  Program p;
  Expr x{&p.graph, add_input(p, "x", f64, Rate::ray)};
  Expr k(double value) { return constant_like(x, value); }
  Program with(Expr f) {
    p.outputs = {{"f", f.id}};
    return p;
  }
};

TEST(Precision, constants_become_the_nearest_number) {
  BuiltFormula b;
  const Program p = b.with(b.x * ((1.0 + sqrt(b.k(5))) / 2.0) + 1.0 / b.k(10));
  const Program in_double = in_precision(p, f64), in_float = in_precision(p, f32);
  EXPECT_EQ(verify(in_double), "");
  EXPECT_EQ(verify(in_float), "");
  EXPECT_EQ(in_double.graph.size(), 5u);  // x, two constants, a product and a sum
  EXPECT_EQ(in_float.graph.size(), 5u);
  EXPECT_EQ(evaluate(in_double, {1.0})[0], 1.6180339887498949 + 0.1);
  EXPECT_EQ(evaluate(in_float, {1.0})[0], 1.6180340f + 0.1f);
  EXPECT_EQ(in_float.inputs[0].type, f32);
  EXPECT_EQ(in_float.graph[in_float.outputs[0].id].type, f32);
}

TEST(Precision, a_constant_output_is_a_constant) {
  BuiltFormula b;
  const Program p = in_precision(b.with(sqrt(b.k(2))), f32);
  EXPECT_EQ(p.graph[p.outputs[0].id].op, Op::constant);
  EXPECT_EQ(evaluate(p, {0.0})[0], 1.41421356f);
}

TEST(Precision, conditions_on_constants_are_decided) {
  BuiltFormula b;
  const Expr two = b.k(2);
  const Expr root = sqrt(two);
  const Expr f = select(root * root <= two, b.x, -b.x) + select(root < 1.5, b.k(10), b.x);
  const Program p = in_precision(b.with(f), f64);
  EXPECT_EQ(evaluate(p, {3.0})[0], 13);
  for (std::uint32_t i = 0; i < p.graph.size(); ++i) EXPECT_NE(p.graph[Id{i}].op, Op::select);
}

TEST(Precision, conversions_vanish) {
  BuiltFormula b;
  const Program p = in_precision(b.with(widen(narrow(b.x)) * 3.0), f32);
  EXPECT_EQ(verify(p), "");
  EXPECT_EQ(p.graph.size(), 3u);
}

TEST(Precision, phases_and_callees_follow) {
  Program p;
  auto callee = std::make_shared<Program>();
  callee->name = "third";
  const Expr a{&callee->graph, add_input(*callee, "a", f64, Rate::ray)};
  callee->outputs = {{"b", (a / 3.0).id}};
  p.name = "loop";
  p.callees.push_back(callee);
  const Expr x{&p.graph, add_input(p, "x", f64, Rate::ray)};
  Loop loop(p, "march", 10);
  const Expr t = loop.state("t", x);
  loop.next(t, {&p.graph, p.graph.call(f64, 0, 0, std::array{t.id})});
  loop.again_while(t > sqrt(constant_like(x, 2)));
  p.outputs = {{"t", loop.result(t).id}};
  ASSERT_EQ(verify(p), "");
  const Program q = in_precision(p, f32);
  ASSERT_EQ(verify(q), "") << to_text(q);
  EXPECT_EQ(evaluate(q, {9.0})[0], 1.0f / 3);
  EXPECT_EQ(evaluate(p, {9.0})[0], 1.0 / 3);
}

TEST(Precision, is_settled_at_once) {
  BuiltFormula b;
  const Program p = in_precision(b.with(b.x * sqrt(b.k(5))), f32);
  EXPECT_TRUE(in_precision(p, f32) == p);
}

TEST(Precision, a_choice_between_equal_constants_is_one) {
  BuiltFormula b;
  const Expr either = select(b.x < 0.0, 1.0 / b.k(10), 2.0 / b.k(20));
  const Program p = in_precision(b.with(b.x + make(Op::exp, either)), f64);
  EXPECT_EQ(p.graph.size(), 3u) << to_text(p);
}

TEST(Precision, zeros_keep_their_sign_and_infinities_stay) {
  BuiltFormula b;
  const Program p = in_precision(b.with(min(b.x * -0.0, b.k(INFINITY))), f32);
  EXPECT_TRUE(std::signbit(evaluate(p, {1.0})[0]));
  EXPECT_EQ(evaluate(p, {NAN})[0], INFINITY);
}

}  // namespace
}  // namespace imp
