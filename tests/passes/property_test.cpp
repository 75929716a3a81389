// What passes promise, on random Programs: the same bits, a fixed point, a legal result.
#include <gtest/gtest.h>

#include "passes/canonicalize.h"
#include "passes/pass.h"
#include "passes/power.h"
#include "passes/precision.h"
#include "passes/rewrite.h"
#include "tests/passes/promise.h"
#include "tests/support/evaluate.h"

namespace imp {
namespace {

using test::evaluate;
using test::Promise;
using test::RandomOptions;

// All kernel passes that promise bits: that is, but for the one that lowers elementary functions.
Program kernel_passes_on_bits(const Program& p) {
  std::vector<Pass> passes;
  for (const Pass& pass : kernel_passes())
    if (pass.preserves == Preserves::bits) passes.push_back(pass);
  return run_passes(p, passes);
}
Program copied(const Program& p) {
  return rewrite(p, [](Graph& graph, Id, const Node& node) { return copy(graph, node); });
}

std::vector<double> inputs_of(const Program& p, std::uint64_t seed) {
  test::Random random(seed);
  std::vector<double> values;
  for (std::size_t i = 0; i < p.inputs.size(); ++i)
    values.push_back(random.one_in(2) ? test::special_values[random.below(std::size(test::special_values))]
                                      : random.between(-4, 4));
  return values;
}

// In the same rounding mode, which a pass may change by removing the last upward op.
bool same_outputs(const Program& p, const Program& q) {
  if (rounds_up(p) != rounds_up(q)) return true;
  const auto a = interpret(p), b = interpret(q);
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const auto in = inputs_of(p, seed);
    const auto v = evaluate(*a, in), w = evaluate(*b, in);
    for (std::size_t i = 0; i < v.size(); ++i)
      if (!test::same_bits(v[i], w[i])) return false;
  }
  return true;
}

class Keeps : public test::Promises {
 protected:
  void expect(const RandomOptions& options, std::uint64_t seeds) {
    const auto run = GetParam().run;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const Program p = test::random_program(seed, options);
      const auto broken = [&](const Program& candidate) { return !verify(run(candidate)).empty(); };
      const auto wrong = [&](const Program& candidate) { return !same_outputs(candidate, run(candidate)); };
      const auto moving = [&](const Program& candidate) {
        const Program once = run(candidate);
        return !(run(once) == once);
      };
      report("an illegal result", seed, p, broken);
      report("other bits", seed, p, wrong);
      report("no fixed point", seed, p, moving);
      if (HasFailure()) return;
    }
  }
};

TEST_P(Keeps, bits_of_formulas) { expect({.nodes = 25}, 400); }
TEST_P(Keeps, bits_in_upward_rounding) { expect({.nodes = 25, .upward = true}, 400); }
TEST_P(Keeps, bits_of_elementary_functions) { expect({.nodes = 25, .elementary = true}, 200); }
TEST_P(Keeps, bits_of_everything) {
  expect({.nodes = 50, .phases = 2, .upward = true, .tables = true, .calls = true, .packets = true}, 300);
}

INSTANTIATE_TEST_SUITE_P(Passes, Keeps,
                         testing::Values(Promise{"copy", copied}, Promise{"canonicalize", canonicalize},
                                         Promise{"powers", reduce_powers}, Promise{"compact", compact},
                                         Promise{"kernel", kernel_passes_on_bits}),
                         [](const auto& test) { return test.param.name; });

TEST(Precision, random_programs_stay_legal_and_settle) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const Program p = test::random_program(
        seed,
        {.nodes = 40, .phases = seed % 3, .f32 = false, .elementary = true, .tables = true, .calls = true});
    for (const Type type : {f32, f64}) {
      const Program q = in_precision(p, type);
      ASSERT_EQ(verify(q), "") << seed << '\n' << to_text(p);
      ASSERT_TRUE(in_precision(q, type) == q) << seed << '\n' << to_text(p) << to_text(q);
      for (const Input& input : q.inputs)
        ASSERT_TRUE(input.type.scalar == Scalar::truth || input.type.element() == type);
    }
  }
}

}  // namespace
}  // namespace imp
