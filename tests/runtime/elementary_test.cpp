// How far the elementary functions are off, sampled: `imp_prove elementary` tries all floats.
#include <gtest/gtest.h>

#include "tests/support/arguments.h"
#include "tests/support/effort.h"
#include "tests/support/elementary_ops.h"
#include "tests/support/function_error.h"
#include "tests/support/shader.h"

namespace imp {
namespace {

using test::FunctionError;
using test::FunctionKernel;

struct Arguments {
  std::vector<double> x, y;
};

// Floats all over their range, or random doubles.
Arguments samples(Op op, Type type) {
  constexpr std::uint64_t stride = test::sanitized ? 2'000'003 : 200'003;
  constexpr std::size_t count = test::sanitized ? 1200 : 20'000;
  Arguments a;
  if (type == f32 && info(op).arity == 1) {
    for (std::uint64_t bits = 0; bits < std::uint64_t{1} << 32; bits += stride)
      a.x.push_back(test::float_of_bits(static_cast<std::uint32_t>(bits)));
    return a;
  }
  std::mt19937_64 random(1);
  for (std::size_t i = 0; i < count; ++i) {
    a.x.push_back(test::random_argument(random, type));
    a.y.push_back(test::random_argument_beside(a.x.back(), random, type));
  }
  return a;
}

// Where functions turn; for two arguments every seventh against all.
Arguments special(Op op, Type type) {
  const std::vector<double> numbers = test::special_arguments(type);
  if (info(op).arity == 1) return {numbers, {}};
  Arguments a;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    for (std::size_t k = i % 7; k < numbers.size(); k += 7) {
      a.x.push_back(numbers[i]);
      a.y.push_back(numbers[k]);
    }
  return a;
}

class Elementary : public testing::TestWithParam<std::tuple<Op, Type, bool>> {
 protected:
  Op op() const { return std::get<0>(GetParam()); }
  Type type() const { return std::get<1>(GetParam()); }
  bool upward() const { return std::get<2>(GetParam()); }

  void expect_within_bounds(const FunctionKernel& kernel, const Arguments& arguments) const {
    const FunctionError error = kernel.measure(arguments.x, arguments.y);
    EXPECT_GT(error.tried, 1000u);
    EXPECT_LE(error.ulps, *elementary::ulps(op(), type()))
        << std::hexfloat << "at " << error.x << ", " << error.y;
    EXPECT_EQ(error.wrong_kind, 0u) << std::hexfloat << "at " << error.wrong_x << ", " << error.wrong_y;
    EXPECT_EQ(error.outside, 0u) << std::hexfloat << "at " << error.wrong_x << ", " << error.wrong_y;
  }
};

std::string function_name(const testing::TestParamInfo<std::tuple<Op, Type, bool>>& test) {
  const auto [op, type, upward] = test.param;
  return std::string(info(op).name) + (type == f32 ? "_f32" : "_f64") + (upward ? "_upward" : "_nearest");
}

INSTANTIATE_TEST_SUITE_P(Functions, Elementary,
                         testing::Combine(testing::ValuesIn(test::elementary_ops()),
                                          testing::Values(f32, f64), testing::Bool()),
                         function_name);

TEST_P(Elementary, is_within_its_bound) {
  const FunctionKernel kernel(op(), type(), upward());
  expect_within_bounds(kernel, samples(op(), type()));
  expect_within_bounds(kernel, special(op(), type()));
}

// Shaders round to nearest, and raise the bounds by other means than machine code.
TEST_P(Elementary, is_within_its_bound_in_shaders) {
  IMP_NEEDS_GL();
  const FunctionKernel kernel(op(), type(), upward(), Backend::glsl);
  expect_within_bounds(kernel, samples(op(), type()));
  expect_within_bounds(kernel, special(op(), type()));
}

}  // namespace
}  // namespace imp
