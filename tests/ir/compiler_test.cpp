// What we take from the compiler for granted, and gcc 12 does not give without
// -fno-tree-slp-vectorize (docs/decisions/compilers.md).
#include <gtest/gtest.h>

#include <array>

namespace imp {
namespace {

[[gnu::noinline]] std::array<double, 2> through_float(double p, double q) {
  const float u = static_cast<float>(p), v = static_cast<float>(q);
  return {u, v};
}

TEST(Compiler, a_conversion_to_float_rounds) {
  const auto [x, y] = through_float(0.1, 0.3);
  EXPECT_NE(x, 0.1);
  EXPECT_NE(y, 0.3);
}

}  // namespace
}  // namespace imp
