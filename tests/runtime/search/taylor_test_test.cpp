// Singh's Taylor test: what it sees that a change of sign does not, and that it is no inclusion.
#include "runtime/search/parts/taylor_test.h"

#include <gtest/gtest.h>

#include <cmath>

#include "passes/pass.h"
#include "tests/support/evaluate.h"
#include "tests/support/make.h"
#include "tests/support/random.h"

namespace imp::test {
namespace {

// f = (s - p)^2 - c + k (s - p)^4, tested on [a, b].
class Tested {
 public:
  Tested() {
    Program program{.name = "test"};
    const Expr a = input(program, "a", f64), b = input(program, "b", f64), p = input(program, "p", f64);
    const Expr c = input(program, "c", f64), k = input(program, "k", f64);
    const auto square = [](Expr r) { return r * r; };
    const RayFunction f{.bound = {},
                        .slope_bound = {},
                        .bound_at = {},
                        .bound_in_double = {},
                        .value = [=](Expr s) { return square(s - p) - c + k * square(square(s - p)); },
                        .slope = [=](Expr s) { return 2.0 * (s - p) + 4.0 * k * (s - p) * square(s - p); },
                        .value_in_double = {},
                        .like = a,
                        .exists = a < b,
                        .certain = truth_of(program.graph, true)};
    output(program, "maybe", taylor_test(f, a, b));
    kernel_ = interpret(run_passes(std::move(program), kernel_passes()));
  }
  bool operator()(double a, double b, double p, double c, double k) const {
    return evaluate(*kernel_, std::array{a, b, p, c, k})[0] != 0;
  }

 private:
  std::unique_ptr<Kernel> kernel_;
};

TEST(TaylorTest, sees_both_roots_of_every_parabola) {
  const Tested test;
  Random random(1);
  int pairs = 0;
  for (int i = 0; i < 2000; ++i) {
    const double p = random.between(0.1, 0.9), c = std::exp2(random.between(-20, -4));
    const double left = p - std::sqrt(c), right = p + std::sqrt(c);
    EXPECT_TRUE(test(0, 1, p, c, 0)) << p << ' ' << c;  // f > 0 at both ends: no change of sign
    pairs += 0 < left && right < 1;
    EXPECT_FALSE(test(right + 0.01, right + 1, p, c, 0)) << p << ' ' << c;
  }
  EXPECT_GT(pairs, 1000);
}

TEST(TaylorTest, may_see_roots_that_are_not_there) { EXPECT_TRUE(Tested()(0, 1, 0.5, -0.01, 0)); }

// f = r^2 - 0.04 - 2.6 r^4 with r = s - 0.5: above 0 at both ends, and so are the tangents; below in the middle.
TEST(TaylorTest, is_no_inclusion) {
  EXPECT_FALSE(Tested()(0, 1, 0.5, 0.04, -2.6));  // and yet
  EXPECT_TRUE(Tested()(0, 0.5, 0.5, 0.04, -2.6));
}

TEST(TaylorTest, takes_nan_for_a_root) { EXPECT_TRUE(Tested()(0, 1, 0.5, std::nan(""), 0)); }

}  // namespace
}  // namespace imp::test
