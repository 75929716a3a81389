// Chebyshev polynomials as sums and products: the same bits as meaning::chebyshev, and near the real value.
#include "passes/chebyshev.h"

#include <gtest/gtest.h>

#include "ir/verify.h"
#include "passes/differentiate.h"
#include "tests/support/chebyshev.h"
#include "tests/support/cost.h"
#include "tests/support/evaluate.h"
#include "tests/support/make.h"
#include "tests/support/random.h"

namespace imp::test {
namespace {

constexpr unsigned some_degrees[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 13, 14, 16, 22, 31, 50};

Expr node(Expr x, double n, double k) {
  return make(Op::chebyshev, x, constant_like(x, n), constant_like(x, k));
}

Program of(unsigned n, unsigned k, Type type = f64) {
  Program p{.name = "f"};
  output(p, "f", node(input(p, "x", type), n, k));
  return p;
}

TEST(Chebyshev, keeps_bits) {
  for (const unsigned n : some_degrees)
    for (unsigned k = 0; k <= std::min(n, 4u); ++k) {
      const Program before = of(n, k), after = reduce_chebyshev(before);
      ASSERT_EQ(verify(after), "");
      EXPECT_EQ(count(after, Op::chebyshev), 0);
      for (const double x : special_values) {
        EXPECT_TRUE(same_bits(evaluate(before, {x})[0], evaluate(after, {x})[0]))
            << n << ' ' << k << " at " << x;
        EXPECT_TRUE(same_bits(evaluate(upward(before), {x, 0})[0], evaluate(upward(after), {x, 0})[0]))
            << n << ' ' << k << " upward at " << x;
      }
    }
}

TEST(Chebyshev, is_what_its_meaning_says) {
  Random random(0xc4eb);
  for (const Type type : {f32, f64})
    for (const unsigned n : some_degrees) {
      const Program p = of(n, 0, type);
      const double ulp = type == f32 ? 0x1p-23 : 0x1p-52;
      for (int i = 0; i < 200; ++i) {
        double x = random.between(-1, 1);
        if (type == f32) x = static_cast<float>(x);
        const double exact = nearest(chebyshev_reference(x, n, 0));
        ASSERT_NEAR(evaluate(p, {x})[0], exact, (1 + n * n) * ulp) << n << " at " << x;
      }
    }
}

TEST(Chebyshev, derivatives_are_chebyshev_too) {
  Random random(0xd1f);
  for (const unsigned n : some_degrees) {
    Program p = of(n, 0);
    Diagnostics diagnostics;
    static constexpr std::string_view x[] = {"x"};
    for (unsigned k = 1; k <= 3; ++k) {
      auto next = differentiate(p, x, diagnostics);
      ASSERT_TRUE(next);
      next->outputs = {next->outputs.back()};
      p = std::move(*next);
      for (int i = 0; i < 50; ++i) {
        const double at = random.between(-1.1, 1.1);
        const double exact = k <= n ? nearest(chebyshev_reference(at, n, k)) : 0;
        const double scale = k <= n ? nearest(chebyshev_reference(1, n, k)) : 0;
        ASSERT_NEAR(evaluate(p, {at})[0], exact, 1e-11 * (scale + std::abs(exact)))
            << n << ' ' << k << " at " << at;
      }
    }
  }
}

TEST(Chebyshev, derivatives_end_with_the_eighth) {
  Diagnostics diagnostics;
  static constexpr std::string_view x[] = {"x"};
  EXPECT_TRUE(differentiate(of(20, 7), x, diagnostics));
  EXPECT_TRUE(differentiate(of(8, 8), x, diagnostics));
  EXPECT_FALSE(differentiate(of(20, 8), x, diagnostics));
  EXPECT_NE(to_text(diagnostics).find("'chebyshev' has no derivative"), std::string::npos);
}

TEST(Chebyshev, sums_and_products_are_few_and_shared) {
  const auto products = [](const Program& p) { return count(reduce_chebyshev(p), Op::mul); };
  EXPECT_EQ(products(of(16, 0)), 4);
  EXPECT_EQ(products(of(14, 0)), 5);
  EXPECT_EQ(products(of(50, 0)), 9);
  EXPECT_LE(products(of(1 << 20, 0)), 20);
  Program p = of(14, 0);
  const Expr x{&p.graph, p.inputs[0].id};
  output(p, "slope", node(x, 14, 1));
  EXPECT_LE(products(p), 14);
}

TEST(Chebyshev, is_done_once) {
  const Program p = reduce_chebyshev(of(14, 1));
  EXPECT_TRUE(reduce_chebyshev(p) == p);
}

}  // namespace
}  // namespace imp::test
