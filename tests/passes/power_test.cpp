// Powers as products: the same bits as meaning::powi, in either rounding mode.
#include "passes/power.h"

#include <gtest/gtest.h>

#include "ir/verify.h"
#include "tests/support/cost.h"
#include "tests/support/evaluate.h"

namespace imp {
namespace {

using test::count;
using test::evaluate;
using test::same_bits;
using test::upward;

Program power_of(double n) {
  Program p;
  const Expr x{&p.graph, add_input(p, "x", f64, Rate::ray)};
  p.outputs = {{"f", make(Op::powi, x, constant_like(x, n)).id}};
  return p;
}

TEST(Power, keeps_bits) {
  for (const double n : {-20.0, -3.0, -2.0, -1.0, 0.0,  1.0,  2.0,  3.0,   4.0,   5.0,
                         6.0,   7.0,  13.0, 15.0, 23.0, 50.0, 77.0, 127.0, 500.0, 1048575.0}) {
    const Program before = power_of(n), after = reduce_powers(before);
    ASSERT_EQ(verify(after), "");
    EXPECT_EQ(count(after, Op::powi), 0);
    for (const double x : test::special_values) {
      EXPECT_TRUE(same_bits(evaluate(before, {x})[0], evaluate(after, {x})[0])) << x << "^" << n;
      EXPECT_TRUE(same_bits(evaluate(upward(before), {x, 0})[0], evaluate(upward(after), {x, 0})[0]))
          << x << "^" << n << " upward";
    }
  }
}

TEST(Power, products_are_few_and_shared) {
  EXPECT_EQ(count(reduce_powers(power_of(2)), Op::mul), 1);
  EXPECT_EQ(count(reduce_powers(power_of(15)), Op::mul), 5);
  EXPECT_EQ(count(reduce_powers(power_of(16)), Op::mul), 4);
  EXPECT_EQ(count(reduce_powers(power_of(-4)), Op::mul), 2);
  EXPECT_EQ(count(reduce_powers(power_of(-4)), Op::div), 1);

  Program p = power_of(8);
  const Expr x{&p.graph, p.inputs[0].id};
  for (const double n : {2.0, 4.0, 5.0, 10.0})
    p.outputs.push_back({"f" + std::to_string(n), make(Op::powi, x, constant_like(x, n)).id});
  EXPECT_EQ(count(reduce_powers(p), Op::mul), 6);  // x^2, x^4, x^8, x^3, x^5, x^10

  Program q = power_of(6);
  const Expr y{&q.graph, q.inputs[0].id};
  q.outputs.push_back({"cube", make(Op::powi, y, constant_like(y, 3)).id});
  EXPECT_EQ(count(reduce_powers(q), Op::mul), 3);
}

TEST(Power, is_done_once) {
  const Program p = reduce_powers(power_of(7));
  EXPECT_TRUE(reduce_powers(p) == p);
}

}  // namespace
}  // namespace imp
