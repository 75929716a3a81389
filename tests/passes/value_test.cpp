// What passes promise that keep the value, on random Programs: the same real number, a legal result, a fixed
// point.
#include <gtest/gtest.h>

#include "passes/horner.h"
#include "passes/reassociate.h"
#include "tests/passes/promise.h"
#include "tests/support/exact.h"
#include "tests/support/random_sums.h"

namespace imp {
namespace {

using test::Promise;

bool same_values(const Program& p, const Program& q) {
  test::Random random(7);
  for (int i = 0; i < 4; ++i) {
    std::vector<double> at;
    for (std::size_t k = 0; k < p.inputs.size(); ++k)
      at.push_back(random.one_in(3) ? static_cast<double>(random.below(5)) - 2 : random.between(-4, 4));
    const auto a = test::exact_values(p, at), b = test::exact_values(q, at);
    for (std::size_t k = 0; k < a.size(); ++k)
      if (!test::same_value(a[k], b[k])) return false;
  }
  return true;
}

class KeepsValue : public test::Promises {
 protected:
  void expect(std::uint64_t seed, const Program& p) {
    const auto run = GetParam().run;
    report("an illegal result", seed, p, [&](const Program& q) { return !verify(run(q)).empty(); });
    report("another value", seed, p, [&](const Program& q) { return !same_values(q, run(q)); });
    report("no fixed point", seed, p, [&](const Program& q) {
      const Program once = run(q);
      return !(run(once) == once);
    });
  }
};

TEST_P(KeepsValue, of_polynomials) {
  for (std::uint64_t seed = 1; seed <= 400 && !HasFailure(); ++seed) expect(seed, test::random_sums(seed));
}

TEST_P(KeepsValue, of_formulas) {
  for (std::uint64_t seed = 1; seed <= 200 && !HasFailure(); ++seed)
    expect(seed, test::random_program(seed, {.nodes = 25, .f32 = false, .special_constants = false}));
}

TEST_P(KeepsValue, of_everything_that_is_legal) {
  const auto run = GetParam().run;
  for (std::uint64_t seed = 1; seed <= 100 && !HasFailure(); ++seed) {
    const Program p = test::random_program(
        seed, {.nodes = 50, .phases = 2, .upward = true, .elementary = true, .tables = true, .calls = true});
    const Program q = run(p);
    ASSERT_EQ(verify(q), "") << to_text(p);
    ASSERT_TRUE(run(q) == q) << to_text(p) << to_text(q) << to_text(run(q));
    EXPECT_EQ(rounds_up(q), rounds_up(p));
  }
}

INSTANTIATE_TEST_SUITE_P(Passes, KeepsValue,
                         testing::Values(Promise{"horner", horner}, Promise{"reassociate", reassociate}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace imp
