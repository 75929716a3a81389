// Exact fractions: what is said of random constants, by a second opinion of 160 bits.
#include "frontend/rational.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iterator>

#include "ir/expr.h"
#include "ir/text.h"
#include "passes/constants.h"
#include "tests/support/random.h"

namespace imp::syntax {
namespace {

class Constants {
 public:
  explicit Constants(std::uint64_t seed) : random_(seed) {}

  Expr make(int depth) {
    if (depth == 0) return leaf();
    const Expr a = make(depth - 1),
               b = make(static_cast<int>(random_.below(static_cast<std::size_t>(depth))));
    switch (random_.below(15)) {
      case 0:
      case 1:  return a + b;
      case 2:  return a - b;
      case 3:  return a * b;
      case 4:
      case 5:  return a / b;
      case 6:  return -abs(a);
      case 7:  return min(a, b);
      case 8:  return max(a, b);
      case 9:  return floor(a);
      case 10: return ceil(a);
      case 11: return imp::make(Op::mod, a, b);
      case 12: return imp::make(Op::powi, a, leaf_integer());
      case 13: return select(a < b && !(b <= a), imp::make(Op::sign, a), b);
      default: return imp::make(random_.one_in(2) ? Op::sqrt : Op::cbrt, a * a * a * a * a * a);
    }
  }
  Program& program() { return program_; }

 private:
  Expr number(double value) { return {&program_.graph, program_.graph.constant(f64, value)}; }
  Expr leaf_integer() { return number(static_cast<double>(random_.below(9)) - 4); }
  Expr leaf() {
    static constexpr double tenths[] = {1, 2, 3, 7, 15, 20, 25, -4};
    return random_.one_in(2) ? leaf_integer() : number(tenths[random_.below(std::size(tenths))]) / 10.0;
  }

  imp::test::Random random_;
  Program program_;
};

// A fraction lies in the enclosure; what has no value is no fraction; what has one all the way is one.
TEST(Rationals, are_what_160_bits_say) {
  int known = 0, integers = 0, undefined = 0;
  for (std::uint64_t seed = 1; seed <= 4000; ++seed) {
    Constants constants(seed);
    const Expr e = constants.make(1 + static_cast<int>(seed % 4));
    Program& program = constants.program();
    program.outputs = {{"c", e.id}};
    const auto all = constant_values(program);
    const auto value = Rationals(program.graph)(e.id);
    const Enclosure& range = *all[e.id.index];
    const auto what = [&] { return fmt::format("seed {}\n{}", seed, to_text(program)); };
    if (range.lo > range.hi) {
      ASSERT_FALSE(value) << what();
      ++undefined;
      continue;
    }
    bool total = true;
    for (const auto& each : all) total = total && each && std::isfinite(each->lo) && std::isfinite(each->hi);
    if (!value) {
      ASSERT_FALSE(total) << what();
      continue;
    }
    ASSERT_TRUE(std::isinf(range.lo) || range.lo <= *value) << what();
    ASSERT_TRUE(std::isinf(range.hi) || *value <= range.hi) << what();
    ++known;
    integers += value->get_den() == 1;
  }
  EXPECT_GT(known, 3000);
  EXPECT_GT(integers, 500);
  EXPECT_GT(known - integers, 500);
  EXPECT_GT(undefined, 100);
}

}  // namespace
}  // namespace imp::syntax
