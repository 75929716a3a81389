// Folds are exact: the same bits in either rounding mode, NaN and signed zeros included.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <bit>

#include "ir/meaning.h"
#include "ir/rounding.h"
#include "tests/support/interesting_values.h"
#include "tests/support/make.h"

namespace imp {
namespace {

using test::input;
using test::number;
using test::truth_input;

class Fold : public testing::Test {
 protected:
  Program p;
  Expr x = input(p, "x"), y = input(p, "y"), w = input(p, "w", f64);
  Truth c = truth_input(p, "c"), d = truth_input(p, "d");

  bool is_op(Expr e, Op op) const { return p.graph[e.id].op == op; }
  std::optional<double> value(Expr e) const { return p.graph.number(e.id); }
};

TEST_F(Fold, what_is_not_representable_stays_an_op) {
  EXPECT_TRUE(is_op(number(p, 1) / number(p, 10), Op::div));
  EXPECT_TRUE(is_op(number(p, 1, f64) / number(p, 10, f64), Op::div));
  EXPECT_TRUE(is_op(number(p, 16777216) + 1.0, Op::add));
  EXPECT_TRUE(is_op(number(p, 1e30) * 1e30, Op::mul));  // overflow
  EXPECT_TRUE(is_op(number(p, 1e-30) * 1e-30, Op::mul));
  EXPECT_TRUE(is_op(sqrt(number(p, 2)), Op::sqrt));
  EXPECT_TRUE(is_op(narrow(number(p, 0.1, f64)), Op::narrow));
  EXPECT_TRUE(is_op(make(Op::sin, number(p, 0)), Op::sin));  // elementary: a pass stands for it
}

TEST_F(Fold, what_is_exact_folds) {
  EXPECT_EQ(value(number(p, 1) / number(p, 8)), 0.125);
  EXPECT_EQ(value(number(p, 16777216, f64) + 1.0), 16777217.0);
  EXPECT_EQ(value(number(p, 3) * 7.0), 21.0);
  EXPECT_EQ(value(sqrt(number(p, 2.25))), 1.5);
  EXPECT_EQ(value(make(Op::powi, number(p, -3), number(p, 5))), -243.0);
  EXPECT_EQ(value(make(Op::powi, number(p, 2), number(p, -3))), 0.125);
  EXPECT_TRUE(is_op(make(Op::powi, number(p, 3), number(p, -1)), Op::powi));
  EXPECT_EQ(value(floor(number(p, -1.5))), -2.0);
  EXPECT_EQ(value(ceil(number(p, 1.5))), 2.0);
  EXPECT_TRUE(is_op(number(p, 1) / 0.0, Op::div));  // the empty set to an enclosure
  EXPECT_TRUE(is_op(sqrt(number(p, -1)), Op::sqrt));
  EXPECT_EQ(value(narrow(number(p, 0.25, f64))), 0.25);
  EXPECT_EQ(value(widen(number(p, 0.1))), static_cast<double>(0.1f));
  EXPECT_EQ(value(fma(number(p, 2), number(p, 3), number(p, 4))), 10.0);
  EXPECT_EQ(p.graph.truth_value((number(p, 1) < 2.0).id), true);
  EXPECT_EQ(p.graph.truth_value((number(p, NAN) <= 2.0).id), false);
}

TEST_F(Fold, upward_ops_of_constants_fold_upward) {
  EXPECT_EQ(value(div_up(number(p, 1), number(p, 10))), 0x1.99999ap-4);
  EXPECT_EQ(value(div_up(number(p, 1), number(p, -10))), -0x1.999998p-4);
  EXPECT_EQ(value(div_up(number(p, 1, f64), number(p, 3, f64))), std::nextafter(1.0 / 3, 1.0));
  EXPECT_EQ(value(add_up(number(p, 16777216), number(p, 1))), 16777218.0);
  EXPECT_EQ(value(mul_up(number(p, 1e30), number(p, -1e30))), -std::numeric_limits<float>::max());
  EXPECT_EQ(value(sqrt_up(number(p, 3, f64))), std::nextafter(std::sqrt(3.0), 2.0));
  EXPECT_EQ(value(narrow_up(number(p, 0.1, f64))), 0.1f);
  EXPECT_EQ(value(narrow_up(number(p, -0.1, f64))), std::nextafter(-0.1f, 0.0f));
  EXPECT_EQ(value(narrow_up(number(p, 1e-300, f64))), std::numeric_limits<float>::denorm_min());
  EXPECT_EQ(value(fma_up(number(p, 16777216), number(p, 1), number(p, 1e-20))), 16777218.0);
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
}

// Every real op at every pair of interesting values: a fold has the bits of both modes.
template <class T>
void folds_are_exact(Type type) {
  Graph g;
  for (int i = 0; i < op_count; ++i) {
    const Op op = static_cast<Op>(i);
    if (info(op).kind != OpKind::real || takes_integers(op) || info(op).arity > 2) continue;
    for (const T a : test::interesting_values<T>())
      for (const T b : test::interesting_values<T>()) {
        const std::array args{g.constant(type, a), g.constant(type, b)};
        const auto folded =
            g.number(g.add(op, std::span(args).first(static_cast<std::size_t>(info(op).arity))));
        if (!folded) continue;
        for (const int mode : {FE_TONEAREST, FE_UPWARD}) {
          volatile T u = a, v = b, result;
          {
            const RoundingMode rounding(mode);
            result = meaning::real<T>(op, u, v, T(0));
          }
          EXPECT_TRUE(std::isnan(result) ? std::isnan(*folded)
                                         : std::bit_cast<std::uint64_t>(static_cast<double>(result)) ==
                                               std::bit_cast<std::uint64_t>(*folded))
              << info(op).name << ' ' << a << ' ' << b << " mode " << mode << ": " << result << " and "
              << *folded;
        }
      }
  }
}

TEST(FoldConstants, f32_has_the_bits_of_both_modes) { folds_are_exact<float>(f32); }
TEST(FoldConstants, f64_has_the_bits_of_both_modes) { folds_are_exact<double>(f64); }

TEST_F(Fold, identities_that_keep_every_bit) {
  EXPECT_EQ(x * 1.0, x);
  EXPECT_EQ(1.0 * x, x);
  EXPECT_EQ(x / 1.0, x);
  EXPECT_EQ(x - 0.0, x);
  EXPECT_EQ(x + -0.0, x);
  EXPECT_EQ(mul_up(x, number(p, 1)), x);
  EXPECT_EQ(add_up(x, number(p, 0)), x);
  EXPECT_EQ(-(-x), x);
  EXPECT_EQ(abs(-x), abs(x));
  EXPECT_EQ(abs(abs(x)), abs(x));
  EXPECT_EQ(min(x, x), x);
  EXPECT_EQ(max(x, x), x);
  EXPECT_EQ(select(c, x, x), x);
  EXPECT_EQ(select(!c, x, y), select(c, y, x));
}

TEST_F(Fold, identities_that_would_lose_a_bit) {
  EXPECT_TRUE(is_op(x + 0.0, Op::add));  // -0 + 0 is 0
  EXPECT_TRUE(is_op(x - -0.0, Op::sub));
  EXPECT_TRUE(is_op(x * 0.0, Op::mul));  // NaN, infinity, -0
  EXPECT_TRUE(is_op(x - x, Op::sub));
  EXPECT_TRUE(is_op(x / x, Op::div));
  EXPECT_TRUE(is_op(x * -1.0, Op::mul));
  EXPECT_TRUE(is_op(min(x, number(p, INFINITY)), Op::min));  // NaN
  EXPECT_TRUE(is_op(max(number(p, -INFINITY), x), Op::max));
  EXPECT_FALSE(p.graph.truth_value(equal(x, x).id).has_value());  // NaN
  EXPECT_FALSE(p.graph.truth_value((x <= x).id).has_value());
}

TEST_F(Fold, min_and_max_give_b_on_nan_and_on_equal_zeros) {
  const Expr nan = number(p, NAN), zero = number(p, 0.0), minus = number(p, -0.0);
  EXPECT_EQ(value(min(nan, number(p, 1))), 1.0);
  EXPECT_TRUE(std::isnan(*value(min(number(p, 1), nan))));
  EXPECT_TRUE(std::signbit(*value(min(zero, minus))));
  EXPECT_FALSE(std::signbit(*value(min(minus, zero))));
  EXPECT_TRUE(std::signbit(*value(max(zero, minus))));
}

TEST_F(Fold, truths) {
  const Truth yes = truth_of(p.graph, true), no = truth_of(p.graph, false);
  EXPECT_EQ((c && yes).id, c.id);
  EXPECT_EQ((yes && c).id, c.id);
  EXPECT_EQ((c && no).id, no.id);
  EXPECT_EQ((c || no).id, c.id);
  EXPECT_EQ((c || yes).id, yes.id);
  EXPECT_EQ((c && c).id, c.id);
  EXPECT_EQ((!!c).id, c.id);
  EXPECT_EQ((!yes).id, no.id);
  EXPECT_EQ((x < x).id, no.id);
  EXPECT_EQ(select(yes, x, y), x);
  EXPECT_EQ(select(no, x, y), y);
  EXPECT_EQ(any(yes).id, yes.id);
  EXPECT_EQ(all(no).id, no.id);
  EXPECT_NE(any(c).id, c.id);
}

TEST_F(Fold, a_load_of_a_filled_table_is_its_value) {
  const Id table = p.graph.fill(table_of(f32, 8), y.id);
  EXPECT_EQ(p.graph.add(Op::load, {table, x.id}), y.id);
  const Id stored = p.graph.add(Op::store, {table, x.id, x.id});
  EXPECT_EQ(p.graph[p.graph.add(Op::load, {stored, x.id})].op, Op::load);
}

TEST_F(Fold, do_not_depend_on_the_mode_of_the_caller) {
  const RoundingMode downward(FE_DOWNWARD);
  EXPECT_TRUE(is_op(number(p, 1) / number(p, 10), Op::div));
  EXPECT_EQ(value(div_up(number(p, 1), number(p, 10))), 0x1.99999ap-4);
  EXPECT_FALSE(std::signbit(*value(number(p, 1) - 1.0)));
  EXPECT_EQ(std::fegetround(), FE_DOWNWARD);
}

}  // namespace
}  // namespace imp
