// Intervals of Chebyshev polynomials and their derivatives: every value lies in them, and they are hardly
// wider than the values are.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "ir/infinity.h"
#include "passes/elementary/lower.h"
#include "passes/extend/chebyshev_extremes.h"
#include "passes/extend/forms.h"
#include "passes/extend/interval.h"
#include "tests/support/boxes.h"
#include "tests/support/chebyshev.h"
#include "tests/support/evaluate.h"
#include "tests/support/make.h"

namespace imp::test {
namespace {

// The k-th derivative of T_n.
struct Derivative {
  unsigned n, k;
};

class ChebyshevRule : public testing::TestWithParam<std::tuple<Derivative, Type>> {
 protected:
  ChebyshevRule() {
    Program f{.name = "f"};
    const Expr x = input(f, "x", f64);
    output(f, "f", make(Op::chebyshev, x, constant_like(x, n), constant_like(x, k)));
    Diagnostics diagnostics;
    const auto extension = imp::extension(f, interval_form, type, diagnostics);
    EXPECT_TRUE(extension) << to_text(diagnostics);
    extension_ = interpret(lower_elementary(*extension));
  }

  Box1 over(Box1 x) const {
    const auto v = evaluate(*extension_, std::array{x.lo, x.hi});
    EXPECT_TRUE(v[2] != 0) << "defined everywhere";
    return {v[0], v[1]};
  }
  double at(double x) const { return nearest(chebyshev_reference(x, n, k)); }

  // Of all sizes, at and around 1, at extremes, and huge.
  Box1 box(Boxes& boxes) const {
    const auto end = [&]() -> double {
      switch (boxes.pick(4)) {
        case 0:  return boxes.pick(2) ? 1 : -1;
        case 1:  return n > 0 ? critical_point(n, static_cast<unsigned>(boxes.pick(n + 1))) : 0;
        case 2:  return boxes.between(0.99, 1.01);
        default: return boxes.between(-1.1, 1.1);
      }
    };
    switch (boxes.pick(6)) {
      case 0: return boxes.box();
      case 1: {
        const double a = end(), b = end();
        return {std::min(a, b), std::max(a, b)};
      }
      case 2: {
        const double a = end();
        return {a, a};
      }
      case 3: {
        const double a = end(), width = std::exp2(-boxes.between(1, 50));
        return boxes.pick(2) ? Box1{a - width, a} : Box1{a, a + width};
      }
      default: return boxes.within(-1.2, 1.2);
    }
  }

  const unsigned n = std::get<0>(GetParam()).n, k = std::get<0>(GetParam()).k;
  const Type type = std::get<1>(GetParam());

 private:
  std::unique_ptr<Kernel> extension_;
};

TEST_P(ChebyshevRule, encloses_every_value) {
  Boxes boxes(0xc4e + n);
  for (int i = 0; i < 200; ++i) {
    const Box1 x = box(boxes), bounds = over(x);
    ASSERT_LE(bounds.lo, bounds.hi) << to_text(x);
    for (int m = 0; m < 6; ++m) {
      const double p = boxes.inside(x);
      const BigInterval value = chebyshev_reference(p, n, k);
      ASSERT_TRUE(mpfr_cmp_d(value.hi(), bounds.lo) >= 0 && mpfr_cmp_d(value.lo(), bounds.hi) <= 0)
          << to_text(x) << fmt::format(" at {} is {}, not in ", p, nearest(value)) << to_text(bounds);
    }
  }
}

// Against the values at the ends and at the extremes, which are the ends of the range. The derivatives of high
// degrees are quotients by 1 - x^2 or its root, and lose what that varies.
TEST_P(ChebyshevRule, is_tight) {
  const bool listed = k == 0 || n <= 24;
  if (!listed && k > 1) return;
  Boxes boxes(0x719);
  std::vector<double> places;
  if (n > k)
    for (const ChebyshevExtreme& e : chebyshev_extremes(n, k)) {
      places.push_back((e.left + e.right) / 2);
      places.push_back(-places.back());
    }
  const double eps = type == f32 ? 0x1p-23 : 0x1p-52, peak = nearest(chebyshev_reference(1, n, k));
  const double steepest = n > k ? nearest(chebyshev_reference(1, n, k + 1)) : 0;
  for (int i = 0; i < 80; ++i) {
    const Box1 x = boxes.within(-1.2, 1.2), bounds = over(x);
    double lo = infinity, hi = -infinity;
    const auto include = [&](double p) {
      lo = std::min(lo, at(p));
      hi = std::max(hi, at(p));
    };
    include(x.lo);
    include(x.hi);
    for (const double p : places)
      if (x.lo < p && p < x.hi) include(p);
    const double scale = std::max({peak, std::abs(lo), std::abs(hi)});
    const double reach = std::min(critical_point(n, 1), std::max(-x.lo, x.hi));
    const double varied = listed ? 0 : (x.hi - x.lo) / (1 - reach * reach);
    const double slack =
        4 * eps * (n * n * scale + steepest * scale / peak) + varied * std::max(std::abs(lo), std::abs(hi));
    const double share = listed ? 1e-3 : 0.6;
    EXPECT_GE(bounds.lo, lo - slack - share * (hi - lo))
        << to_text(x) << to_text(Box1{lo, hi}) << to_text(bounds);
    EXPECT_LE(bounds.hi, hi + slack + share * (hi - lo))
        << to_text(x) << to_text(Box1{lo, hi}) << to_text(bounds);
  }
}

// So that a root of T_n is known to be the only one around.
TEST_P(ChebyshevRule, excludes_0_around_the_roots_of_the_polynomial) {
  if (k != 1) return;
  for (unsigned j = 0; j < n; ++j) {
    const auto place = [&](double turns) { return std::cos(std::numbers::pi * turns / n); };
    const Box1 x{place(j + 0.85), place(j + 0.15)}, bounds = over(x);
    EXPECT_TRUE(bounds.lo > 0 || bounds.hi < 0) << to_text(x) << to_text(bounds);
  }
}

std::vector<Derivative> derivatives() {
  std::vector<Derivative> all;
  for (const unsigned n :
       {0u, 1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u, 9u, 12u, 14u, 15u, 16u, 17u, 22u, 24u, 25u, 50u})
    for (unsigned k = 0; k <= std::min(n, 3u); ++k) all.push_back({n, k});
  return all;
}

std::string derivative_name(const testing::TestParamInfo<std::tuple<Derivative, Type>>& test) {
  const auto& [c, type] = test.param;
  return fmt::format("T{}_{}_{}", c.n, c.k, type == f32 ? "f32" : "f64");
}

INSTANTIATE_TEST_SUITE_P(degrees, ChebyshevRule,
                         testing::Combine(testing::ValuesIn(derivatives()), testing::Values(f32, f64)),
                         derivative_name);

TEST(ChebyshevRules, ranges_fold) {
  Program f{.name = "f"};
  const Expr x = input(f, "x", f64);
  for (const double n : {7.0, 14.0, 50.0})
    for (const double k : {0.0, 1.0, 2.0})
      output(f, fmt::format("f{}{}", n, k), make(Op::chebyshev, x, constant_like(x, n), constant_like(x, k)));
  for (const Range box : {Range{-0.5, 0.25}, {0.25, 0.25}, {-2, 2}, {1, 1e300}, {-infinity, infinity}})
    for (const Type type : {f32, f64}) {
      const auto known = ranges(f, std::array{box}, type);
      for (const Output& o : f.outputs) ASSERT_TRUE(known[o.id.index]) << o.name;
      if (box.bounded_by(1)) { EXPECT_LE(known[f.outputs[0].id.index]->hi, 1); }
    }
}

TEST(ChebyshevRules, a_degree_beyond_what_floats_resolve_is_unbounded_outside) {
  Program f{.name = "f"};
  const Expr x = input(f, "x", f64);
  output(f, "f", make(Op::chebyshev, x, constant_like(x, 1 << 20), constant_like(x, 0)));
  Diagnostics diagnostics;
  const auto kernel = interpret(lower_elementary(*imp::extension(f, interval_form, f32, diagnostics)));
  const auto inside = evaluate(*kernel, std::array{0.1, 0.2}),
             outside = evaluate(*kernel, std::array{1.0, 1.5});
  EXPECT_EQ(inside[0], -1);
  EXPECT_EQ(inside[1], 1);
  EXPECT_LE(outside[0], 1);
  EXPECT_EQ(outside[1], infinity);
}

}  // namespace
}  // namespace imp::test
