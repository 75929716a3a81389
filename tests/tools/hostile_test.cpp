// A sample of what `tools/dev prove hostile` tries, and what it found.
#include "tests/support/hostile.h"

#include <gtest/gtest.h>

#include "tests/support/effort.h"

namespace imp {
namespace {

constexpr double much_too_long = 60;  // seconds: a machine may be busy

TEST(Hostile, input_is_answered) {
  test::Hostile cases(20261201);
  for (std::size_t i = 0; i < test::effort(60); ++i) {
    const test::HostileCase each = cases.next();
    const test::HostileAnswer answer = test::run(each, test::sanitized ? 20 * much_too_long : much_too_long);
    EXPECT_EQ(answer.problem, "") << test::to_text(each, answer);
  }
}

}  // namespace
}  // namespace imp
