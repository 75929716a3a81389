// The reference at numbers written out; that it computes the last column of ir/ops.def: agreement_test.cpp.
#include <gtest/gtest.h>

#include "ir/verify.h"
#include "tests/support/evaluate.h"
#include "tests/support/make.h"
#include "tests/support/rays.h"

namespace imp {
namespace {

using test::input;
using test::number;
using test::output;
using test::same_bits;

// `op` over inputs of that type.
Program of(Op op, Type type) {
  Program p;
  std::vector<Id> args;
  for (int i = 0; i < info(op).arity; ++i)
    args.push_back(input(p, std::string(1, static_cast<char>('a' + i)), type).id);
  if (takes_integers(op)) return p;  // has constant operands
  p.outputs.push_back({"f", p.graph.add(op, args)});
  return p;
}

struct Known {
  Op op;
  std::vector<double> args;
  double value;
};

const double inf = INFINITY, nan = NAN;

const std::vector<Known> known{
    {Op::add, {1, 2}, 3},
    {Op::add, {0.0, -0.0}, 0.0},
    {Op::add, {inf, -inf}, nan},
    {Op::sub, {1, 3}, -2},
    {Op::sub, {2, 2}, 0.0},
    {Op::mul, {-3, 2}, -6},
    {Op::mul, {0, inf}, nan},
    {Op::mul, {-0.0, 2}, -0.0},
    {Op::div, {1, 4}, 0.25},
    {Op::div, {1, -0.0}, -inf},
    {Op::div, {0, 0}, nan},
    {Op::fma, {2, 3, 4}, 10},
    {Op::neg, {0}, -0.0},
    {Op::abs, {-2.5}, 2.5},
    {Op::abs, {-0.0}, 0.0},
    {Op::min, {1, 2}, 1},
    {Op::min, {nan, 2}, 2},  // b if either is NaN
    {Op::min, {2, nan}, nan},
    {Op::min, {0.0, -0.0}, -0.0},
    {Op::min, {-0.0, 0.0}, 0.0},
    {Op::max, {1, 2}, 2},
    {Op::max, {nan, 2}, 2},
    {Op::max, {2, nan}, nan},
    {Op::max, {0.0, -0.0}, -0.0},
    {Op::sqrt, {6.25}, 2.5},
    {Op::sqrt, {-0.0}, -0.0},
    {Op::sqrt, {-1}, nan},
    {Op::floor, {-1.5}, -2},
    {Op::floor, {-0.0}, -0.0},
    {Op::ceil, {1.25}, 2},
    {Op::ceil, {-0.5}, -0.0},
    {Op::sign, {-7}, -1},
    {Op::sign, {-0.0}, -0.0},
    {Op::sign, {nan}, nan},
    {Op::mod, {7, 3}, 1},
    {Op::mod, {-7, 3}, 2},
    {Op::mod, {7, -3}, -2},
    {Op::exponent, {8}, 3},
    {Op::exponent, {-0.75}, -1},
    {Op::exponent, {0}, -inf},
    {Op::exponent, {-inf}, inf},
    {Op::exponent, {0x1p-140}, -140},  // a denormal f32
    {Op::exponent, {nan}, nan},
    {Op::scale2, {1.5, 3}, 12},
    {Op::scale2, {1.5, 3.9}, 12},
    {Op::scale2, {1.5, -1e30}, 0},
    {Op::scale2, {-1.5, 1e30}, -inf},
    {Op::scale2, {0, inf}, 0},
    {Op::scale2, {1, nan}, nan},
    {Op::pow, {-2, 2}, nan},
    {Op::pow, {nan, 0}, nan},  // what has no value has no powers
    {Op::pow, {0, 0}, 1},
    {Op::pow, {1, nan}, nan},
    {Op::pow, {4, 0.5}, 2},
    {Op::lt, {1, 2}, 1},
    {Op::lt, {nan, 2}, 0},
    {Op::le, {-0.0, 0.0}, 1},
    {Op::eq, {-0.0, 0.0}, 1},
    {Op::eq, {nan, nan}, 0},
};

TEST(InterpreterOps, known_values_in_f32_and_f64) {
  for (const Known& k : known)
    for (const Type type : {f32, f64}) {
      const double value = test::evaluate(of(k.op, type), k.args)[0];
      EXPECT_TRUE(same_bits(value, k.value))
          << info(k.op).name << ' ' << k.args[0] << " in " << to_text(type) << ": " << value;
    }
}

TEST(InterpreterOps, powers) {
  for (const Type type : {f32, f64})
    for (const double n : {-7.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0, 5.0, 10.0, 18.0}) {
      Program p;
      output(p, "f", make(Op::powi, input(p, "x", type), number(p, n, type)));
      EXPECT_EQ(test::evaluate(p, {2})[0], std::ldexp(1.0, static_cast<int>(n)));
      EXPECT_EQ(test::evaluate(p, {-2})[0],
                std::ldexp(std::fmod(n, 2) == 0 ? 1.0 : -1.0, static_cast<int>(n)));
      EXPECT_TRUE(std::isnan(test::evaluate(p, {NAN})[0]));  // for n = 0 too: there is nothing to raise
    }
}

TEST(InterpreterOps, f32_rounds_to_f32_and_f64_to_f64) {
  EXPECT_EQ(test::evaluate(of(Op::div, f32), {1, 3})[0], 1.0f / 3.0f);
  EXPECT_EQ(test::evaluate(of(Op::div, f64), {1, 3})[0], 1.0 / 3.0);
  EXPECT_EQ(test::evaluate(of(Op::add, f32), {16777216, 1})[0], 16777216);
  EXPECT_EQ(test::evaluate(of(Op::add, f64), {16777216, 1})[0], 16777217);
}

TEST(InterpreterOps, conversions) {
  EXPECT_EQ(test::evaluate(of(Op::widen, f32), {0.1})[0], static_cast<double>(0.1f));
  EXPECT_EQ(test::evaluate(of(Op::narrow, f64), {0.3})[0], static_cast<double>(0.3f));
  EXPECT_EQ(test::evaluate(of(Op::narrow, f64), {1e300})[0], INFINITY);
  EXPECT_EQ(test::evaluate(of(Op::narrow_up, f64), {-0.1})[0], std::nextafter(-0.1f, 0.0f));
  EXPECT_EQ(test::evaluate(of(Op::narrow_up, f64), {1e-300})[0], std::numeric_limits<float>::denorm_min());
  EXPECT_EQ(test::evaluate(of(Op::narrow_up, f64), {-1e300})[0], -std::numeric_limits<float>::max());
}

TEST(InterpreterOps, logic_and_choice) {
  Program p;
  const Truth a = test::truth_input(p, "a"), b = test::truth_input(p, "b");
  const Expr x = input(p, "x"), y = input(p, "y");
  output(p, "and", a && b);
  output(p, "or", a || b);
  output(p, "not", !a);
  output(p, "any", any(a));
  output(p, "all", all(a));
  output(p, "select", select(a, x, y));
  for (const bool u : {false, true})
    for (const bool v : {false, true})
      EXPECT_EQ(test::evaluate(p, {double(u), double(v), NAN, -0.0}).size(), 6u);
  EXPECT_EQ(test::evaluate(p, {1, 0, 5, 6}), (std::vector<double>{0, 1, 0, 1, 1, 5}));
  EXPECT_EQ(test::evaluate(p, {0, 1, 5, 6}), (std::vector<double>{0, 1, 1, 0, 0, 6}));
  EXPECT_EQ(test::evaluate(p, {1, 1, 5, 6}), (std::vector<double>{1, 1, 0, 1, 1, 5}));
}

TEST(InterpreterOps, inputs_of_all_rates_reach_all_rays) {
  Program p;
  const Expr r = input(p, "r", f32, Rate::frame), k = input(p, "k", f64, Rate::cell), x = input(p, "x");
  const Truth c = test::truth_input(p, "c");
  output(p, "f", widen(r * x) + k);
  output(p, "c", !c);
  test::Rays rays(p, 3);
  rays.fill(0, 10);
  rays.fill(1, 0.125);
  for (std::size_t i = 0; i < 3; ++i) rays.set(2, i, static_cast<double>(i)), rays.set(3, i, i == 1);
  rays.run(*interpret(p));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(rays.get(0, i), 10.0 * static_cast<double>(i) + 0.125);
    EXPECT_EQ(rays.get(1, i), i != 1);
  }
}

TEST(InterpreterOps, outputs_that_are_not_wanted_may_be_null) {
  Program p;
  const Expr x = input(p, "x");
  output(p, "a", x);
  output(p, "b", x * 2.0);
  const float in = 3;
  float out = 0;
  const void* const from[] = {&in};
  void* const to[] = {nullptr, &out};
  interpret(p)->run({1, from, to});
  EXPECT_EQ(out, 6);
}

TEST(InterpreterOps, a_program_of_five_million_nodes) {
  Program p;
  const Expr x = input(p, "x");
  Expr z = x;
  for (int i = 0; i < 2'500'000; ++i) z = (z + x) * 0.5;
  output(p, "z", z);
  EXPECT_EQ(test::evaluate(p, {3})[0], 3);
}

}  // namespace
}  // namespace imp
