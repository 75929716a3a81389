// What is promised of plain ops in an enclosure: faithfully rounded, in any direction. Rounded down, all
// of them, no enclosure may miss a value; so no rule leans on a plain op where it needs one upward.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "passes/elementary/lower.h"
#include "passes/extend/inclusion.h"
#include "passes/pass.h"
#include "passes/power.h"
#include "tests/support/ball.h"
#include "tests/support/boxes.h"
#include "tests/support/evaluate.h"
#include "tests/support/every_form.h"
#include "tests/support/formula.h"
#include "tests/support/rounded_down.h"

namespace imp::test {
namespace {

const NamedFormula mixed_formulas[] = {
    {"sum", [](Expr x, Expr y) { return x + y - 0.1 * x; }},
    {"product", [](Expr x, Expr y) { return x * y; }},
    {"square", [](Expr x, Expr y) { return x * x * y; }},
    {"scaled", [](Expr x, Expr y) { return 3.0 * x - y * 7.0; }},
    {"quotient", [](Expr x, Expr y) { return x / y; }},
    {"over 3", [](Expr x, Expr y) { return x / 3.0 + y; }},
    {"reciprocal", [](Expr x, Expr y) { return 1.0 / (2.0 + x * x) + y; }},
    {"root", [](Expr x, Expr y) { return sqrt(abs(x)) * y; }},
    {"fma", [](Expr x, Expr y) { return fma(x, y, x); }},
    {"powers", [](Expr x, Expr y) { return power(x, 5) + power(y, 4); }},
    {"negative powers", [](Expr x, Expr y) { return power(x, -3) * y; }},
    {"corners", [](Expr x, Expr y) { return max(x * y, abs(x) - y); }},
    {"branches", [](Expr x, Expr y) { return select(x < y, x * y, x + y); }},
    {"exponential", [](Expr x, Expr y) { return make(Op::exp, x) * y; }},
    {"logarithm", [](Expr x, Expr y) { return make(Op::log, abs(x)) * y; }},
    {"waves", [](Expr x, Expr y) { return make(Op::sin, x) * make(Op::cos, y); }},
    {"angle", [](Expr x, Expr y) { return make(Op::atan2, y, x); }},
    {"real power", [](Expr x, Expr y) { return make(Op::pow, abs(x), y); }},
};

class PlainOps : public testing::TestWithParam<Inclusion> {};

TEST_P(PlainOps, may_round_down) {
  std::size_t tried = 0;
  for (const NamedFormula& formula : mixed_formulas)
    for (const Type type : {f32, f64}) {
      const Program f = program_of(formula.build);
      Diagnostics diagnostics;
      const auto enclosure = extension(f, *GetParam().enclose, type, diagnostics);
      ASSERT_EQ(enclosure.has_value(), !may_refuse(GetParam(), f)) << to_text(diagnostics);
      if (!enclosure) continue;
      const auto kernel = interpret(lower_elementary(rounded_down(*enclosure)));
      Boxes boxes(0xd0);
      for (int i = 0; i < 250; ++i) {
        const auto box = [&] {
          const Box1 any = boxes.pick(3) == 0 ? boxes.within(-4, 4) : boxes.box();
          return boxes.pick(3) == 0 && std::isfinite(any.lo) ? Box1{any.lo, any.lo} : any;
        };
        const Box1 a = box(), b = box();
        const auto found = evaluate(*kernel, std::array{a.lo, a.hi, b.lo, b.hi});
        for (int k = 0; k < 3; ++k) {
          const std::array p{boxes.inside(a), boxes.inside(b)};
          if (!std::isfinite(p[0]) || !std::isfinite(p[1])) continue;
          const Ball value = ball_values(f, p)[0];
          ++tried;
          ASSERT_FALSE(value.certainly_outside(found[0], found[1]))
              << formula.name << ", " << to_text(type)
              << fmt::format(" over [{:a}, {:a}], [{:a}, {:a}] at {:a}, {:a} is {:a}, not in [{:a}, {:a}]",
                             a.lo, a.hi, b.lo, b.hi, p[0], p[1], value.nearest(), found[0], found[1]);
        }
      }
    }
  EXPECT_GT(tried, 5000u);
}

INSTANTIATE_TEST_SUITE_P(Forms, PlainOps, every_form(), form_name);

}  // namespace
}  // namespace imp::test
