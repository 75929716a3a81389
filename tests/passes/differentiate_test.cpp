// Derivatives against central differences in 160 bits, at the special points, and how much work they are.
#include "passes/differentiate.h"

#include <gtest/gtest.h>

#include "ir/loop.h"
#include "ir/text.h"
#include "ir/verify.h"
#include "passes/constants.h"
#include "passes/precision.h"
#include "passes/rewrite.h"
#include "tests/support/evaluate.h"
#include "tests/support/random.h"

namespace imp {
namespace {

using test::evaluate;

// A surface under construction.
struct BuiltSurface {
  Program p;
  Expr x{&p.graph, add_input(p, "x", f64, Rate::ray)};
  Expr y{&p.graph, add_input(p, "y", f64, Rate::ray)};
  Expr z{&p.graph, add_input(p, "z", f64, Rate::ray)};

  Expr k(double value) { return constant_like(x, value); }
  const Program& with(Expr f) {
    p.outputs = {{"f", f.id}};
    return p;
  }
};

Program gradient_of(const Program& f) {
  Diagnostics diagnostics;
  auto result = gradient(f, diagnostics);
  EXPECT_TRUE(result) << to_text(diagnostics);
  if (!result) return f;
  EXPECT_EQ(verify(*result), "");
  return *result;
}

Program hessian_of(const Program& f) {
  Diagnostics diagnostics;
  auto result = hessian(f, diagnostics);
  EXPECT_TRUE(result) << to_text(diagnostics);
  if (!result) return f;
  EXPECT_EQ(verify(*result), "");
  return *result;
}

using Point = std::array<double, 3>;

// `output` of `f` at `at`, as nodes of `graph`.
Expr placed(Graph& graph, const Program& f, std::size_t output, std::array<Expr, 3> at) {
  std::vector<Id> now;
  for (std::uint32_t i = 0; i < f.graph.size(); ++i) {
    const Node node = f.graph[Id{i}];
    std::vector<Id> args;
    for (const Id arg : node.args) args.push_back(now[arg.index]);
    now.push_back(node.op == Op::input ? at[node.payload].id : rebuild(graph, node, args, node.payload));
  }
  return {&graph, now[f.outputs[output].id.index]};
}

// `output` of `f` at `at` in 160 bits, or its derivative there by central differences, as a double.
double exact(const Program& f, std::size_t output, Point at, int derivative = -1) {
  Graph graph;
  const auto number = [&](double value) { return Expr{&graph, graph.constant(f64, value)}; };
  const auto moved = [&](double by) {
    std::array<Expr, 3> place{number(at[0]), number(at[1]), number(at[2])};
    if (derivative >= 0) {
      Expr& moving = place[static_cast<std::size_t>(derivative)];
      moving = moving + by;
    }
    return placed(graph, f, output, place);
  };
  constexpr double h = 0x1p-50;  // error about 2^-100; what cancels leaves 110 bits
  const Expr value = derivative < 0 ? moved(0) : (moved(h) - moved(-h)) / number(2 * h);
  Program constant;
  constant.graph = graph;
  return constant_values(constant)[value.id.index]->nearest;
}

// The derivatives are outputs 1 to 3 (f: 0), the second ones 4 to 9, of which each is one of `base`.
void expect_derivatives(const Program& f, Point at, const std::string& what) {
  const Program g = hessian_of(f);
  constexpr std::array<std::array<std::size_t, 2>, 9> base{
      {{0, 0}, {0, 1}, {0, 2}, {1, 0}, {1, 1}, {1, 2}, {2, 1}, {2, 2}, {3, 2}}};
  for (std::size_t i = 0; i < base.size(); ++i) {
    const double expected = exact(g, base[i][0], at, static_cast<int>(base[i][1]));
    const double found = exact(g, i + 1, at);
    if (std::isnan(expected)) continue;
    ASSERT_NEAR(found, expected, 1e-14 * (1 + std::abs(expected)))
        << what << ": " << g.outputs[i + 1].name << " at " << testing::PrintToString(at) << '\n'
        << to_text(f);
  }
  const auto values = evaluate(in_precision(g, f64), at);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double expected = exact(g, i, at);
    if (std::isnan(expected)) continue;
    ASSERT_NEAR(values[i], expected, 1e-9 * (1 + std::abs(expected))) << what << ": " << g.outputs[i].name;
  }
}

// Where each op is smooth.
struct Domain {
  double lo, hi;
};
Domain domain(Op op) {
  switch (op) {
    case Op::sqrt:
    case Op::log:
    case Op::pow:
    case Op::div:
    case Op::mod:
    case Op::cbrt:  return {0.2, 3};
    case Op::asin:
    case Op::acos:
    case Op::atanh: return {-0.9, 0.9};
    case Op::acosh: return {1.1, 3};
    default:        return {-1.5, 1.5};
  }
}

constexpr Op differentiable[] = {
    Op::add,   Op::sub,  Op::mul,   Op::div,  Op::fma,   Op::neg,   Op::abs,   Op::min,
    Op::max,   Op::sqrt, Op::floor, Op::ceil, Op::sign,  Op::mod,   Op::pow,   Op::cbrt,
    Op::exp,   Op::log,  Op::sin,   Op::cos,  Op::tan,   Op::asin,  Op::acos,  Op::atan,
    Op::atan2, Op::sinh, Op::cosh,  Op::tanh, Op::asinh, Op::acosh, Op::atanh,
};

TEST(Differentiate, every_op) {
  test::Random random(5);
  for (const Op op : differentiable) {
    for (int round = 0; round < 8; ++round) {
      BuiltSurface b;
      const auto [lo, hi] = domain(op);
      const Point at{random.between(lo, hi), random.between(lo, hi), random.between(lo, hi)};
      const std::array<Expr, 3> variables{b.x, b.y, b.z};
      std::vector<Id> args;
      for (int i = 0; i < info(op).arity; ++i) args.push_back(variables[static_cast<std::size_t>(i)].id);
      const Expr value{&b.p.graph, b.p.graph.add(op, args)};
      expect_derivatives(b.with(value * make(Op::exp, b.y)), at, std::string(info(op).name));
    }
  }
}

TEST(Differentiate, powers) {
  test::Random random(6);
  for (const double n : {-1048576.0, -3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0, 4.0, 7.0, 0.5, 1.5, -0.5}) {
    BuiltSurface b;
    const bool whole = n == std::floor(n);
    const Point at{n < -10 ? 1.000001 : random.between(0.5, 2), random.between(0.5, 2), 0};
    expect_derivatives(b.with(make(Op::pow, b.x, b.k(n)) * b.y), at, "pow");
    if (whole) expect_derivatives(b.with(make(Op::powi, b.x, b.k(n)) * b.y), at, "powi");
  }
  BuiltSurface b;
  expect_derivatives(b.with(make(Op::pow, b.k(2), b.x) + make(Op::pow, b.x, b.y * b.z)), {1.3, 0.7, 2},
                     "x^y");
}

// Compositions of everything, at random points.
TEST(Differentiate, compositions) {
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    test::Random random(seed);
    BuiltSurface b;
    std::vector<Expr> known{b.x, b.y, b.z, b.k(0.75), b.k(2)};
    const auto any = [&] { return known[random.below(known.size())]; };
    const auto tame = [&](Expr e) { return make(Op::tanh, e); };
    for (int i = 0; i < 8; ++i) {
      const Expr a = any(), c = any();
      switch (random.below(14)) {
        case 0: known.push_back(a + c); break;
        case 1: known.push_back(a - c); break;
        case 2: known.push_back(a * c); break;
        case 3: known.push_back(a / (1.0 + c * c)); break;
        case 4: known.push_back(min(a, c)); break;
        case 5: known.push_back(select(a < c, a * c, abs(c))); break;
        case 6:
          known.push_back(make(Op::powi, tame(a), b.k(static_cast<double>(2 + random.below(4)))));
          break;
        case 7:  known.push_back(sqrt(1.0 + a * a)); break;
        case 8:  known.push_back(make(Op::sin, a)); break;
        case 9:  known.push_back(make(Op::exp, tame(a))); break;
        case 10: known.push_back(make(Op::atan2, a, 2.0 + abs(c))); break;
        case 11: known.push_back(make(Op::log, 2.0 + make(Op::cos, a))); break;
        case 12: known.push_back(make(Op::pow, 1.5 + tame(a), c)); break;
        default: known.push_back(fma(a, c, any())); break;
      }
    }
    const Point at{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
    expect_derivatives(b.with(known.back() + known[known.size() - 2]), at, "seed " + std::to_string(seed));
    if (HasFailure()) return;
  }
}

// f, fx, fy, fz at a point.
std::vector<double> slopes(const Program& f, Point at) { return evaluate(gradient_of(f), at); }

TEST(Differentiate, the_branch_not_taken_is_zero) {
  BuiltSurface b;
  const Program& f = b.with(make(Op::acosh, max(b.k(1), abs(b.x))));
  EXPECT_EQ(slopes(f, {0, 0, 0})[1], 0);
  EXPECT_EQ(slopes(f, {0.5, 0, 0})[1], 0);
  EXPECT_EQ(slopes(f, {1, 0, 0})[1], INFINITY);  // max takes its second operand: the slope from outside
  EXPECT_NEAR(slopes(f, {-2, 0, 0})[1], -1 / std::sqrt(3.0), 1e-15);
  EXPECT_EQ(evaluate(hessian_of(f), {0.0, 0.0, 0.0})[4], 0);
  EXPECT_NEAR(evaluate(hessian_of(f), {2.0, 0.0, 0.0})[4], -2 / std::pow(3.0, 1.5), 1e-14);
}

TEST(Differentiate, the_branch_not_taken_is_zero_in_sums_and_products) {
  BuiltSurface b;
  const Expr pole = make(Op::log, max(b.k(0), b.x));  // -inf, and so the factor of its derivative
  const Program& f = b.with(select(b.x > 0.0, pole * b.y, b.k(3)) + b.y * b.y + max(b.x, b.k(0)) * b.y);
  const auto left = slopes(f, {-1, 2, 0});
  EXPECT_EQ(left[0], 7);
  EXPECT_EQ(left[1], 0);
  EXPECT_EQ(left[2], 4);
  const auto right = slopes(f, {2, 2, 0});
  EXPECT_EQ(right[1], 1 + 2);
  EXPECT_EQ(right[2], std::log(2) + 4 + 2);
}

TEST(Differentiate, ties_follow_the_value) {
  BuiltSurface b;  // min is a < b ? a : b, so b at a tie; abs is a < 0 ? -a : a
  EXPECT_EQ(slopes(b.with(min(b.x, b.y)), {1, 1, 0}), (std::vector<double>{1, 0, 1, 0}));
  EXPECT_EQ(slopes(b.with(max(b.x, b.y)), {1, 1, 0}), (std::vector<double>{1, 0, 1, 0}));
  EXPECT_EQ(slopes(b.with(abs(b.x)), {0, 0, 0}), (std::vector<double>{0, 1, 0, 0}));
  EXPECT_EQ(slopes(b.with(abs(b.x)), {-3, 0, 0}), (std::vector<double>{3, -1, 0, 0}));
  EXPECT_EQ(slopes(b.with(select(b.x < b.y && !(b.z < 0.0), b.x, 2.0 * b.y)), {1, 2, 0}),
            (std::vector<double>{1, 1, 0, 0}));
}

TEST(Differentiate, zero_to_a_power) {
  BuiltSurface b;
  EXPECT_EQ(slopes(b.with(make(Op::pow, b.x, b.y)), {0, 2, 0}), (std::vector<double>{0, 0, 0, 0}));
  EXPECT_EQ(slopes(b.with(make(Op::pow, b.x, b.k(0))), {0, 0, 0}), (std::vector<double>{1, 0, 0, 0}));
  EXPECT_EQ(slopes(b.with(make(Op::pow, b.x, b.k(1))), {0, 0, 0}), (std::vector<double>{0, 1, 0, 0}));
}

std::size_t size_of(const Program& p) { return compact(p).graph.size(); }

TEST(Differentiate, no_idle_work) {
  BuiltSurface b;
  const Program linear = gradient_of(b.with(3.0 * b.x + b.y * b.z - b.k(7)));
  EXPECT_EQ(linear.graph.number(linear.output("fx")->id), 3.0) << to_text(linear);
  EXPECT_EQ(linear.output("fy")->id, linear.input("z")->id);
  EXPECT_EQ(linear.output("fz")->id, linear.input("y")->id);
  EXPECT_EQ(size_of(linear), size_of(b.p));

  // x^3: x^2 and 3 x^2 come new, and the constants
  const Program cube = gradient_of(b.with(make(Op::powi, b.x, b.k(3))));
  EXPECT_EQ(size_of(cube), size_of(b.p) + 4) << to_text(cube);  // 2, 0, x^2, 3*x^2

  const Program flat = gradient_of(b.with(floor(b.x) + make(Op::sign, b.y) + ceil(b.z)));
  for (const char* name : {"fx", "fy", "fz"}) EXPECT_EQ(flat.graph.number(flat.output(name)->id), 0.0);

  const Program gone = gradient_of(b.with(b.x - b.x + b.y * 0.0));
  EXPECT_EQ(gone.graph.number(gone.output("fx")->id), 0.0);
}

TEST(Differentiate, outputs_have_names_in_order) {
  BuiltSurface b;
  const Program h = hessian_of(b.with(b.x * b.y * b.z));
  std::vector<std::string> names;
  for (const Output& output : h.outputs) names.push_back(output.name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"f", "fx", "fy", "fz", "fxx", "fxy", "fxz", "fyy", "fyz", "fzz"}));
  EXPECT_EQ(h.output("fyz")->id, h.input("x")->id);

  Diagnostics diagnostics;
  const Expr g = b.x * b.x;
  Program two = b.p;
  two.outputs.push_back({"g", g.id});
  constexpr std::string_view inputs[] = {"z", "x"};
  const auto d = differentiate(two, inputs, diagnostics);
  ASSERT_TRUE(d);
  names.clear();
  for (const Output& output : d->outputs) names.push_back(output.name);
  EXPECT_EQ(names, (std::vector<std::string>{"f", "g", "fz", "fx", "gz", "gx"}));
}

TEST(Differentiate, what_has_no_derivative_is_told) {
  BuiltSurface b;
  const Expr e = make(Op::exponent, b.x);
  b.p.graph.set_span(e.id, {0, 14, 25});
  Diagnostics diagnostics;
  EXPECT_FALSE(gradient(b.with(e * b.y), diagnostics));
  ASSERT_EQ(diagnostics.errors(), 1u);
  EXPECT_EQ(diagnostics.all()[0].message, "'exponent' has no derivative");
  EXPECT_EQ(diagnostics.all()[0].span, (Span{0, 14, 25}));

  Diagnostics none;
  EXPECT_TRUE(gradient(b.with(make(Op::exponent, b.k(3)) * b.y), none));  // of a constant it does

  Loop loop(b.p, "march", 3);
  const Expr t = loop.state("t", b.x);
  loop.next(t, t * t);
  Diagnostics in_loop;
  EXPECT_FALSE(gradient(b.with(loop.result(t)), in_loop));
  EXPECT_EQ(in_loop.all()[0].message, "'result' has no derivative");

  Diagnostics unknown;
  constexpr std::string_view inputs[] = {"w"};
  EXPECT_FALSE(differentiate(b.with(b.x), inputs, unknown));
  EXPECT_TRUE(unknown.has_errors());
}

TEST(Differentiate, spans_are_those_of_the_formula) {
  BuiltSurface b;
  const Expr e = make(Op::sin, b.x * b.y);
  b.p.graph.set_span(e.id, {0, 3, 9});
  const Program g = gradient_of(b.with(e));
  EXPECT_EQ(g.graph.span(g.output("fx")->id), (Span{0, 3, 9}));
}

}  // namespace
}  // namespace imp
