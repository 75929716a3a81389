// The elementary functions as basic ops: none is left, work is shared, names and places stay.
#include "passes/elementary/lower.h"

#include <gtest/gtest.h>

#include "ir/text.h"
#include "ir/verify.h"
#include "tests/support/cost.h"
#include "tests/support/elementary_ops.h"
#include "tests/support/make.h"

namespace imp {
namespace {

using test::cost;
using test::input;
using test::output;

Program program_of(std::initializer_list<Op> functions, Type type) {
  Program p;
  const Expr x = input(p, "x", type), y = input(p, "y", type);
  for (const Op op : functions)
    output(p, std::string(info(op).name), info(op).arity == 1 ? make(op, x) : make(op, x, y));
  return p;
}

// The kinds of ops that every backend spells for both types.
bool basic(const Node& node) {
  switch (info(node.op).kind) {
    case OpKind::real:      return node.op != Op::fma && node.op != Op::mod && !takes_integers(node.op);
    case OpKind::compare:
    case OpKind::logic:
    case OpKind::choice:
    case OpKind::structure: return true;
    default:                return false;
  }
}

class LowerElementary : public testing::TestWithParam<std::tuple<Op, Type>> {
 protected:
  Op op() const { return std::get<0>(GetParam()); }
  Type type() const { return std::get<1>(GetParam()); }

  Program lowered() const { return lower_elementary(program_of({op()}, type())); }
};

std::string name_of(const testing::TestParamInfo<std::tuple<Op, Type>>& test) {
  const auto [op, type] = test.param;
  return std::string(info(op).name) + (type == f32 ? "_f32" : "_f64");
}

INSTANTIATE_TEST_SUITE_P(Functions, LowerElementary,
                         testing::Combine(testing::ValuesIn(test::elementary_ops()),
                                          testing::Values(f32, f64)),
                         name_of);

TEST_P(LowerElementary, leaves_basic_ops_of_one_type) {
  const Program p = compact(lowered());
  ASSERT_EQ(verify(p), "");
  EXPECT_EQ(p.graph[p.outputs[0].id].type, type());
  for (std::uint32_t i = 0; i < p.graph.size(); ++i) {
    const Node node = p.graph[Id{i}];
    EXPECT_TRUE(basic(node)) << info(node.op).name;
    EXPECT_TRUE(node.type == type() || node.type == truth) << info(node.op).name;
  }
}

TEST_P(LowerElementary, is_done_once) {
  const Program p = lowered();
  EXPECT_TRUE(lower_elementary(p) == p);
}

TEST_P(LowerElementary, keeps_names_and_places) {
  Program p = program_of({op()}, type());
  p.graph.set_name(p.outputs[0].id, "wave");
  p.graph.set_span(p.outputs[0].id, {.file = 0, .begin = 3, .end = 7});
  const Program after = lower_elementary(p);
  EXPECT_EQ(after.graph.name(after.outputs[0].id), "wave");
  EXPECT_EQ(after.graph.span(after.outputs[0].id), p.graph.span(p.outputs[0].id));
}

TEST(LowerElementary, shares_work) {
  for (const auto& [one, other] : {std::pair{Op::sin, Op::cos}, {Op::sinh, Op::cosh}}) {
    const auto cost_of = [](std::initializer_list<Op> functions) {
      return cost(lower_elementary(program_of(functions, f32)));
    };
    const std::size_t apart = cost_of({one}) + cost_of({other});
    EXPECT_LT(cost_of({one, other}), apart * 3 / 4) << info(one).name << ' ' << info(other).name;
  }
}

}  // namespace
}  // namespace imp
