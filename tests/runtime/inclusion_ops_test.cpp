// Every op in every form, in float and in double, on 100 000 random boxes: no value lies outside, and
// none is called defined and continuous that is not (tools/dev prove inclusions tries more).
#include <gtest/gtest.h>

#include "tests/support/effort.h"
#include "tests/support/inclusion_trial.h"

namespace imp::test {
namespace {

constexpr std::size_t batch = 2500, batches = sanitized ? 1 : 40;

class InclusionOfOp : public testing::TestWithParam<OpForm> {};

TEST_P(InclusionOfOp, holds_every_value) {
  for (const Type type : {f32, f64}) {
    const InclusionTrial trial(GetParam(), inclusions(), type);
    ASSERT_GE(trial.forms(), 1u);
    std::vector<InclusionCount> counts(trial.forms());
    for (std::size_t i = 0; i < batches; ++i) {
      const auto more = trial.run(i, batch);
      for (std::size_t k = 0; k < counts.size(); ++k) counts[k].add(more[k]);
    }
    for (std::size_t k = 0; k < counts.size(); ++k) {
      SCOPED_TRACE(std::string(trial.form(k)) + ", " + to_text(type));
      EXPECT_EQ(counts[k].misses, 0u) << counts[k].first;
      EXPECT_EQ(counts[k].overclaimed, 0u) << counts[k].first;
      EXPECT_GT(counts[k].values, counts[k].boxes);
    }
  }
}

std::string op_name(const testing::TestParamInfo<OpForm>& test) {
  std::string name = test.param.name;
  for (char& c : name)
    if (c == '^' || c == '-') c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Ops, InclusionOfOp, testing::ValuesIn(op_forms()), op_name);

}  // namespace
}  // namespace imp::test
