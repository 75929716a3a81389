// Affine forms enclose: every op over operands that depend on each other, on boxes within a domain, by the
// bounds and by the parts of the form themselves.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>

#include "ir/text.h"
#include "ir/verify.h"
#include "passes/extend/affine_rules.h"
#include "passes/extend/forms.h"
#include "passes/pass.h"
#include "passes/rewrite.h"
#include "tests/support/boxes.h"
#include "tests/support/evaluate.h"
#include "tests/support/exact.h"
#include "tests/support/make.h"

namespace imp::test {
namespace {

constexpr std::size_t dimension = 6;
constexpr double largest = 4;  // of the domain
const std::string names[dimension] = {"x", "y", "z", "u", "v", "w"};

using Point = std::array<double, dimension>;
using Build = std::function<Expr(std::span<const Expr>)>;

Program program_of_all(const Build& build) {
  Program f{.name = "f"};
  std::vector<Expr> at;
  for (const std::string& name : names) at.push_back(input(f, name, f64));
  output(f, "f", build(at));
  return f;
}

struct Way {
  Type type;
  std::size_t symbols;
  bool domain;
  AffineOptions options;

  std::string name() const {
    return fmt::format("{} of {} symbols{}{}{}", to_text(type), symbols, domain ? ", in the domain" : "",
                       options.intersect ? ", intersected" : "",
                       options.signed_errors ? ", with signed errors" : "");
  }
};

// The bounds of f, whether it is defined, then the form of f: c, both ends of e, x1, ...; the forms of the variables; and
// the limit of the form of f.
Program extended(const Program& f, const Way& way) {
  Program result{.name = "form"};
  std::vector<Interval> sides;
  std::vector<std::size_t> variables;
  for (std::size_t i = 0; i < dimension; ++i) {
    const Expr lo = input(result, names[i] + "lo", f64), hi = input(result, names[i] + "hi", f64);
    sides.push_back(way.type == f32 ? interval(narrow_up(-lo), narrow_up(hi)) : interval(-lo, hi));
    if (i < way.symbols) variables.push_back(i);
  }
  std::array<Range, dimension> domain;
  domain.fill({-largest, largest});
  const InputBox box{sides, variables,
                     way.domain ? std::span<const Range>(domain) : std::span<const Range>()};
  Diagnostics diagnostics;
  const auto value = affine_values(f, box, diagnostics, way.options);
  const AffineRules rules(f, box, way.options);
  if (!value) throw std::runtime_error(to_text(diagnostics));
  const auto wide = [&](Expr end) { return way.type == f32 ? widen(end) : end; };
  const AffineRules::Value& of_f = value->front();
  output(result, "lo", wide(of_f.range.lo()));
  output(result, "hi", wide(of_f.range.hi));
  output(result, "empty", of_f.range.empty);
  output(result, "continuous", of_f.range.continuous);
  output(result, "c", wide(of_f.form->c));
  output(result, "e nlo", wide(of_f.form->e.nlo));
  output(result, "e hi", wide(of_f.form->e.hi));
  for (std::size_t i = 0; i < way.symbols; ++i) output(result, names[i], wide(of_f.form->x[i]));
  for (const std::size_t i : variables) {
    const auto side = rules.input(i);
    output(result, names[i] + " c", wide(side.form->c));
    output(result, names[i] + " x", wide(side.form->x[i]));
  }
  output(result, "limit", constant_like(Expr{&result.graph, result.inputs[0].id}, of_f.form->limit));
  EXPECT_EQ(verify(result), "");
  return result;
}

std::vector<double> ends_of(std::span<const Box1> box) {
  std::vector<double> ends;
  for (const Box1& side : box) ends.insert(ends.end(), {side.lo, side.hi});
  return ends;
}

void expect_enclosed(const Way& way, std::span<const double> v, const Point& at, const Enclosure& value,
                     const std::string& about) {
  const auto where = [&] {
    return fmt::format("{}: {} is {} in [{}, {}]", way.name(), about, value.nearest, v[0], v[1]);
  };
  ASSERT_FALSE(v[2] == 0 && (std::isnan(v[0]) || std::isnan(v[1]))) << where();
  if (value.lo > value.hi) {
    ASSERT_EQ(v[3], 0) << where();
    return;
  }
  ASSERT_EQ(v[2], 0) << where();
  ASSERT_TRUE(v[0] <= value.hi && value.lo <= v[1]) << where();

  const long double below = v[5], above = v[6];
  long double middle = v[4], size = std::abs(middle);
  for (std::size_t i = 0; i < way.symbols; ++i) {
    const double* variable = &v[7 + way.symbols + 2 * i];
    const long double u = (static_cast<long double>(at[i]) - variable[0]) / variable[1];
    if (variable[1] != 0) {
      ASSERT_LE(std::abs(u), 1 + 1e-15L) << where();
      middle += u * v[7 + i];
    }
    size += std::abs(v[7 + i]);
  }
  ASSERT_TRUE(!(size + std::max(below, above) > v.back())) << where() << ", beyond " << v.back();
  if (!(size + below + above < HUGE_VALL)) return;                       // no form
  const long double slack = size * (way.type == f32 ? 1e-15L : 1e-14L);  // of this computation
  ASSERT_TRUE(value.lo - above - slack <= middle && middle <= value.hi + below + slack)
      << where() << fmt::format(", {} - {} + {}", static_cast<double>(middle), v[5], v[6]);
}

// A formula whose operands depend on each other.
struct Entangled {
  const char* name;
  Build build;
};

Expr mean(std::span<const Expr> x) { return (x[0] + x[1] + x[2] + x[3] + x[4] + x[5]) / 6.0; }  // of all

#define IMP_OF(expression)                      \
  [](std::span<const Expr> p) {                 \
    const Expr x = p[0], y = p[1], m = mean(p); \
    (void)x, (void)y, (void)m;                  \
    return expression;                          \
  }
const Entangled entangled[] = {
    {"sums", IMP_OF(x + 2.0 * y - m + 0.1)},
    {"product of one", IMP_OF(x * (1.0 - x))},
    {"product", IMP_OF((x + y) * (m - y))},
    {"product with zero", IMP_OF(0.0 * x + y)},
    {"scaled", IMP_OF(0.1 * x - y * 0.25 + m / 3.0 - x / 0.7 + x / -4.0 - 2.0 * y)},
    {"scaled beyond floats", IMP_OF(x * 1e40 / 1e40 - y * 3e-41 * 1e41 + m / 1e39)},
    {"scaled beyond doubles",
     IMP_OF(x * 1e200 * 1e200 / power(constant_like(x, 1e200), 2) - y / 1e305 / 1e-305)},
    {"doubled beyond floats", IMP_OF(x * 0x1p96 * 0x1p96 * 0x1p-96 * 0x1p-96 + y)},
    {"doubled beyond doubles", IMP_OF(x * 0x1p990 * 0x1p990 * 0x1p-990 * 0x1p-990 - y)},
    {"nearly no factor", IMP_OF(1e30 * x / 2e38 + y / 1e-39 * 1e-39)},
    {"square", IMP_OF((x - y) * (x - y))},
    {"square of one", IMP_OF(x* x - x)},
    {"cube", IMP_OF(power(x + m, 3))},
    {"powers", IMP_OF(power(x, 5) + power(y, 6) - power(m, 7) + power(x, 12))},
    {"negative power", IMP_OF(power(x + 5.0, -3))},
    {"x^500", IMP_OF(power(x, 500) + y)},
    {"reciprocal", IMP_OF(1.0 / (x + 5.0))},
    {"negative reciprocal", IMP_OF(-2.0 / (x - m - 9.0))},
    {"reciprocal across", IMP_OF(1.0 / x)},
    {"quotient", IMP_OF((x + y) / (6.0 + x - m))},
    {"abs", IMP_OF(abs(x + y))},
    {"abs of a square", IMP_OF(abs(x* x))},
    {"max", IMP_OF(max(x + y, m))},
    {"min", IMP_OF(min(x* y, m) - m)},
    {"max of undefined", IMP_OF(max(sqrt(x), y))},
    {"sqrt", IMP_OF(sqrt(x + y + 8.5))},
    {"sqrt at zero", IMP_OF(sqrt(x* x + y * y) - 1.0)},
    {"sqrt across", IMP_OF(sqrt(x))},
    {"exp", IMP_OF(make(Op::exp, x - y))},
    {"gauss", IMP_OF(make(Op::exp, -(x* x) - m * m))},
    {"log", IMP_OF(make(Op::log, x + m + 9.0))},
    {"log across", IMP_OF(make(Op::log, x))},
    {"sin", IMP_OF(make(Op::sin, x + 3.0 * y))},
    {"cos", IMP_OF(make(Op::cos, x* y) - x)},
    {"sin far", IMP_OF(make(Op::sin, 4e3 * x))},
    {"tan", IMP_OF(make(Op::tan, x + m))},
    {"asin", IMP_OF(make(Op::asin, 0.2 * x))},
    {"acos", IMP_OF(make(Op::acos, 0.5 * x))},
    {"atan", IMP_OF(make(Op::atan, x - m))},
    {"sinh", IMP_OF(make(Op::sinh, x))},
    {"cosh", IMP_OF(make(Op::cosh, m + y))},
    {"tanh", IMP_OF(make(Op::tanh, x))},
    {"asinh", IMP_OF(make(Op::asinh, x))},
    {"acosh", IMP_OF(make(Op::acosh, x + 2.0))},
    {"atanh", IMP_OF(make(Op::atanh, 0.3 * x))},
    {"cbrt", IMP_OF(make(Op::cbrt, x + m))},
    {"pow", IMP_OF(make(Op::pow, x + 3.0, constant_like(x, 1.5)))},
    {"pow of both", IMP_OF(make(Op::pow, x + 5.0, y))},
    {"atan2", IMP_OF(make(Op::atan2, x, y))},
    {"mod", IMP_OF(make(Op::mod, x, y + 5.0) - x)},
    {"steps", IMP_OF(make(Op::floor, x) + make(Op::ceil, y) + make(Op::sign, m))},
    {"if", IMP_OF(select(x < y, x* y, m))},
    {"if both", IMP_OF(select(x < y && m < x, x* y, m))},
    {"fma", IMP_OF(make(Op::fma, x, y, -(x* m)))},
};
#undef IMP_OF

class EveryForm : public testing::TestWithParam<Entangled> {};

// As a driver may run it: of the results below the smallest normal number none is left; upward ones are raised.
Program flushed(const Program& program) {
  return rewrite(program, [](Graph& graph, Id, const Node& node) {
    const Expr r{&graph, copy(graph, node)};
    const bool up = info(node.op).kind == OpKind::upward || node.op == Op::narrow_up;
    const bool rounds = up || node.op == Op::add || node.op == Op::sub || node.op == Op::mul ||
                        node.op == Op::div || node.op == Op::fma || node.op == Op::sqrt;
    if (node.type != f32 || !rounds) return r.id;
    const Expr least = up ? select(r > 0, constant_like(r, 0x1p-126), zero(r)) : zero(r);
    return select(abs(r) < 0x1p-126, least, r).id;
  });
}

void expect_forms_enclose(const Entangled& formula, double scale, Program (*change)(const Program&)) {
  const Program f = program_of_all(formula.build);
  std::vector<std::pair<Way, std::unique_ptr<Kernel>>> ways;
  for (const Type type : {f32, f64})
    for (const std::size_t symbols : {1u, 2u, 3u, 6u})
      for (const int mode : {0, 1, 2, 3, 4, 5}) {
        const Way way{
            type, symbols, mode % 2 != 0, {.intersect = mode / 2 == 1, .signed_errors = mode / 2 == 2}};
        ways.emplace_back(way, interpret(change(run_passes(extended(f, way), kernel_passes()))));
      }
  Boxes boxes(0xaff);
  for (int i = 0; i < 40; ++i) {
    std::array<Box1, dimension> box;
    for (Box1& side : box) side = boxes.within(-scale, scale);
    if (boxes.pick(4) == 0) box[0].hi = box[0].lo;
    if (boxes.pick(8) == 0) box.fill({-scale, scale});
    std::vector<std::vector<double>> results;
    for (const auto& [way, kernel] : ways) results.push_back(evaluate(*kernel, ends_of(box)));
    for (int k = 0; k < 4; ++k) {
      Point at;
      for (std::size_t j = 0; j < dimension; ++j) at[j] = boxes.inside(box[j]);
      const Enclosure value = exact_values(f, at)[0];
      for (std::size_t w = 0; w < ways.size(); ++w) {
        expect_enclosed(ways[w].first, results[w], at, value, formula.name);
        if (testing::Test::HasFatalFailure()) return;
      }
    }
  }
}

TEST_P(EveryForm, encloses_every_value) {
  expect_forms_enclose(GetParam(), largest, [](const Program& p) { return p; });
}
TEST_P(EveryForm, encloses_what_nearly_vanishes) {
  expect_forms_enclose(GetParam(), 1e-19, flushed);
  expect_forms_enclose(GetParam(), 1e-37, flushed);
}

INSTANTIATE_TEST_SUITE_P(formulas, EveryForm, testing::ValuesIn(entangled), [](const auto& test) {
  std::string name = test.param.name;
  std::ranges::replace_if(name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
  return name;
});

}  // namespace
}  // namespace imp::test
