// Ends in the wrong order, or NaN, of what is not empty: no search proves anything by them, on any backend.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "runtime/search/parts/proven.h"
#include "runtime/search/search.h"
#include "tests/backends/llvm_support.h"
#include "tests/support/make.h"
#include "tests/support/shader.h"

namespace imp {
namespace {

struct Runner {
  std::string name;
  std::function<std::unique_ptr<Kernel>(const Program&)> compile;
};

std::vector<Runner> runners() {
  std::vector<Runner> all{{"interpreter", [](const Program& program) { return interpret(program); }}};
  for (const CpuTarget& target : targets_here())
    all.push_back({target.name, [target](const Program& program) { return compiled(program, target); }});
  if (GlContext::get()) all.push_back({"glsl", test::shader_of});
  return all;
}

constexpr double huge = 3.4028234e38;

// Ends [-nlo, hi] that prove nothing: of both signs at once, of one sign, and not known.
const std::vector<Column> useless{{-5, -huge, -5, -INFINITY, -5, 5, 0, NAN, NAN, -5, NAN},
                                  {-5, -huge, 3, -INFINITY, 0, -7, -3, NAN, -5, NAN, 5}};
// Ends that are in order.
const std::vector<Column> useful{{-1, 5, 1, 0, -2, INFINITY}, {2, -4, 1, 0, 2, -1}};

// Of each pair of ends one row: the sign that it proves, whether it may be 0, and what a comparison with 0 may be.
std::vector<Column> told(const Runner& runner, const std::vector<Column>& ends) {
  Program program{.name = "told"};
  const Expr nlo = test::input(program, "nlo"), hi = test::input(program, "hi");
  const Interval a = interval(nlo, hi), none = point(zero(hi));
  const IntervalRules rules;
  const auto add = [&](const char* name, Truth truth) { program.outputs.push_back({name, truth.id}); };
  test::output(program, "sign", proven_sign(a));
  add("may_be_zero", may_be_zero(a));
  for (const Possible& p : {rules.lt(a, none), rules.lt(none, a), rules.le(a, none), rules.eq(a, none)})
    add(program.outputs.size() % 2 == 0 ? "yes" : "no", p.yes), add("other", p.no);
  for (std::size_t i = 0; i < program.outputs.size(); ++i) program.outputs[i].name += std::to_string(i);
  return run(*runner.compile(program), ends, ends[0].size());
}

TEST(InvertedEnds, prove_no_sign_and_decide_no_comparison) {
  for (const Runner& runner : runners()) {
    const auto got = told(runner, useless);
    for (std::size_t row = 0; row < useless[0].size(); ++row) {
      SCOPED_TRACE(runner.name + ", row " + std::to_string(row));
      EXPECT_EQ(got[0][row], 0);
      for (std::size_t i = 1; i < got.size(); ++i) EXPECT_EQ(got[i][row], 1) << "output " << i;
    }
    const auto known = told(runner, useful);
    EXPECT_EQ(known[0], (Column{1, -1, 0, 0, 1, -1})) << runner.name;
    EXPECT_EQ(known[1], (Column{0, 0, 1, 1, 0, 0})) << runner.name;
  }
}

// A search for a linear f from -1 to 1, whose enclosures are replaced where `wrong`.
struct Wrong {
  bool values, slopes;
};

Program search_with(const Search& search, Wrong wrong) {
  Program program{.name = "search"};
  const Expr nlo = test::input(program, "nlo"), hi = test::input(program, "hi");
  const Interval replaced = interval(nlo, hi), slope = point(2.0 * one(hi));
  const auto f = [](Expr s) { return 2.0 * s - 1.0; };
  const auto bound = [=](const Interval& s) {
    const Interval right = interval(fma_up(constant_like(s.hi, 2), s.nlo, one(s.hi)),
                                    fma_up(constant_like(s.hi, 2), s.hi, -one(s.hi)));
    return wrong.values ? replaced : right;
  };
  const RayFunction ray{
      .bound = bound,
      .slope_bound = [=](const Interval&) { return wrong.slopes ? replaced : slope; },
      .bound_at = [=](Expr s) { return bound(point(s)); },
      .bound_in_double = {},
      .value = f,
      .slope = [](Expr s) { return 2.0 * one(s); },
      .value_in_double = [=](Expr s) { return f(to(f64, s)); },
      .like = hi,
      .exists = truth_of(program.graph, true),
      .certain = truth_of(program.graph, true),
      .degree = [](Diagnostics&) { return RayDegree{1, {}}; },
      .coefficients = [=](const Interval& s, Diagnostics&) -> std::optional<std::vector<Interval>> {
        return std::vector<Interval>{wrong.values ? replaced : bound(point(s.lo())), bound(point(s.hi))};
      }};
  Diagnostics diagnostics;
  const auto found = search.build(program, ray, {{}, 256}, diagnostics);
  EXPECT_TRUE(found.has_value()) << search.name;
  test::output(program, "verdict", found->verdict);
  return program;
}

TEST(InvertedEnds, certify_nothing_in_any_search) {
  for (const Runner& runner : runners())
    for (const Search& search : searches()) {
      const auto verdicts = [&](Wrong wrong) {
        return run(*runner.compile(search_with(search, wrong)), useless, useless[0].size())[0];
      };
      SCOPED_TRACE(fmt::format("{}, {}", runner.name, search.name));
      EXPECT_EQ(verdicts({true, false}), Column(useless[0].size(), verdict_undecided));
      EXPECT_EQ(verdicts({true, true}), Column(useless[0].size(), verdict_undecided));
      for (const double verdict : verdicts({false, true})) EXPECT_NE(verdict, verdict_miss);
      for (const double verdict : verdicts({false, false})) EXPECT_EQ(verdict, verdict_hit);
    }
}

}  // namespace
}  // namespace imp
