// What each form of inclusion function is for: how fast its excess shrinks, and where it must give way.
#include "passes/extend/forms.h"
#include "ir/infinity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "passes/pass.h"
#include "tests/passes/extend/bounds.h"
#include "tests/support/every_form.h"
#include "tests/support/exact.h"
#include "tests/support/formula.h"

namespace imp::test {
namespace {

Expr sine(Expr a) { return make(Op::sin, a); }
Expr exponential(Expr a) { return make(Op::exp, a); }

class Enclosed {
 public:
  Enclosed(const Formula& formula, Form& form, Type type = f64) : f_(program_of(formula)) {
    Diagnostics diagnostics;
    kernel_ = interpret(run_passes(*extension(f_, form, type, diagnostics), kernel_passes()));
  }
  Bounds over(Box1 x, Box1 y) const { return bounds_over(*kernel_, x, y); }
  const Program& f() const { return f_; }

 private:
  Program f_;
  std::unique_ptr<Kernel> kernel_;
};

Box1 around(double middle, double width) { return {middle - width / 2, middle + width / 2}; }

// The width beyond that of the range over x, y fixed, as far as samples and both ends tell.
double excess(const Enclosed& enclosed, double x, double y, double width) {
  const Box1 box = around(x, width);
  double lo = infinity, hi = -infinity;
  for (int i = 0; i <= 256; ++i) {
    const Enclosure value =
        exact_values(enclosed.f(), std::array{box.lo + i * (box.hi - box.lo) / 256, y})[0];
    lo = std::min(lo, value.hi);
    hi = std::max(hi, value.lo);
  }
  return enclosed.over(box, {y, y}).width() - (hi - lo);
}

// Not monotone at 0.3, so that the vertex of a parabola matters.
const Formula smooth[] = {
    [](Expr x, Expr y) { return (x * x - 0.6 * x) * (power(x, 3) + 2.0) + y; },
    [](Expr x, Expr y) { return sine(3.0 * x) * exponential(x) - x * y; },
    [](Expr x, Expr y) { return (x + y) / (1.0 + x * x) - sqrt(x + 2.0); },
};

struct Order {
  const char* name;
  Form* form;
  double order;
};
void PrintTo(const Order& order, std::ostream* out) { *out << order.name; }

class Converges : public testing::TestWithParam<Order> {};

TEST_P(Converges, excess_shrinks_with_the_order) {
  for (const Formula& formula : smooth) {
    const Enclosed enclosed(formula, *GetParam().form);
    for (const double x : {0.3, -0.4, 0.9}) {
      const double wide = excess(enclosed, x, 0.7, 0x1p-5), narrow = excess(enclosed, x, 0.7, 0x1p-8);
      // what samples miss of an extremum inside is below (width/256)^2
      EXPECT_LT(narrow, 1.3 * wide * std::exp2(-3 * GetParam().order + 0.5) + 1e-9) << x;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Forms, Converges,
                         testing::Values(Order{"mean_value", mean_value_form, 2},
                                         Order{"slope", slope_form, 2}, Order{"taylor", taylor_form, 2},
                                         Order{"cubic", cubic_form, 3}, Order{"af1", affine_form, 2},
                                         Order{"af1_ia", affine_and_interval_form, 2},
                                         Order{"af2", signed_affine_form, 2}),
                         [](const auto& test) { return test.param.name; });

TEST(Forms, all_enclose_smooth_formulas) {
  for (const Inclusion& inclusion : inclusions())
    for (const Type type : {f32, f64})
      for (const Formula& formula : smooth) {
        if (may_refuse(inclusion, program_of(formula))) continue;
        const Enclosed enclosed(formula, *inclusion.enclose, type);
        Boxes boxes(7);
        for (int i = 0; i < 300; ++i) {
          const Box1 x = boxes.within(-1.5, 2), y = boxes.within(-1, 1);
          const double px = boxes.inside(x), py = boxes.inside(y);
          const Enclosure value = exact_values(enclosed.f(), std::array{px, py})[0];
          const Bounds bounds = enclosed.over(x, y);
          ASSERT_TRUE(bounds.lo <= value.hi && value.lo <= bounds.hi)
              << inclusion.name << " [" << x.lo << ", " << x.hi << "] " << px << ", " << py;
          ASSERT_TRUE(bounds.defined);
        }
      }
}

TEST(Forms, slopes_are_no_wider_than_derivatives) {
  for (const Formula& formula : smooth) {
    const Enclosed slopes(formula, slope_form), derivatives(formula, mean_value_form);
    Boxes boxes(3);
    double narrower = 0;
    for (int i = 0; i < 300; ++i) {
      const Box1 x = boxes.within(-1.5, 2), y = boxes.within(-1, 1);
      const double a = slopes.over(x, y).width(), b = derivatives.over(x, y).width();
      narrower += a < 0.99 * b;
      EXPECT_LE(a, b * 1.0001 + 1e-12);
    }
    EXPECT_GT(narrower, 30);
  }
}

TEST(Forms, slopes_go_around_corners) {
  const Enclosed slopes([](Expr x, Expr y) { return abs(x) - 0.5 * x + y; }, slope_form);
  const Bounds bounds = slopes.over({-1, 1}, {0, 0});
  EXPECT_TRUE(bounds.defined);
  EXPECT_LE(bounds.hi, 1.5);
  EXPECT_GE(bounds.lo, -1.5);
}

// A jump has no slope, an edge of the domain none that is finite: intervals stand in.
TEST(Forms, intervals_stand_in_where_a_form_does_not_hold) {
  const Formula formulas[] = {
      [](Expr x, Expr y) { return floor(x) + y; },
      [](Expr x, Expr y) { return 1.0 / x + y; },
      [](Expr x, Expr y) { return sqrt(x) - y; },
      [](Expr x, Expr y) { return select(x < 0.25, x, 3.0 + y); },
      [](Expr x, Expr y) { return make(Op::log, x) * y; },
  };
  for (const Formula& formula : formulas)
    for (const Inclusion& inclusion : inclusions()) {
      if (may_refuse(inclusion, program_of(formula))) continue;
      const Enclosed form(formula, *inclusion.enclose), intervals(formula, interval_form);
      const Bounds a = form.over({-1, 1}, {0.5, 0.75}), b = intervals.over({-1, 1}, {0.5, 0.75});
      EXPECT_LE(a.lo, b.lo) << inclusion.name;
      EXPECT_GE(a.hi, b.hi) << inclusion.name;
      EXPECT_FALSE(a.defined) << inclusion.name;
    }
}

// Where the second derivative has no value at all: at a place where the first one still is.
TEST(Forms, a_place_without_a_second_derivative_is_enclosed) {
  const Formula formula = [](Expr x, Expr y) { return make(Op::pow, x, constant_like(x, 1.5)) + y * y; };
  for (const Inclusion& inclusion : inclusions()) {
    if (may_refuse(inclusion, program_of(formula))) continue;
    const Bounds bounds = Enclosed(formula, *inclusion.enclose).over({0, 0}, {1, 2});
    EXPECT_LE(bounds.lo, 1) << inclusion.name;
    EXPECT_GE(bounds.hi, 4) << inclusion.name;
    EXPECT_TRUE(bounds.hi < infinity) << inclusion.name;
  }
}

TEST(Forms, a_corner_of_the_slope_bends_no_parabola) {
  const Formula formulas[] = {
      [](Expr x, Expr y) { return x * abs(x) + y; },
      [](Expr x, Expr y) { return abs(x) + 0.125 * x + y; },
  };
  for (const Formula& formula : formulas)
    for (Form* form : {&taylor_form, &cubic_form}) {
      const Enclosed enclosed(formula, *form);
      for (const double x : {-1.0, 0.0, 1.0}) {
        const Bounds bounds = enclosed.over({-1, 1}, {0, 0});
        const double value = exact_values(enclosed.f(), std::array{x, 0.0})[0].nearest;
        EXPECT_LE(bounds.lo, value);
        EXPECT_GE(bounds.hi, value);
      }
    }
}

// One branch of the corner has no derivative on all of the box: 0/0, at the root of what is 0 there.
TEST(Forms, a_branch_without_a_derivative_counts) {
  const Formula formulas[] = {
      [](Expr x, Expr y) { return max(sqrt(x * floor(y)) + 10.0 * x, x); },
      [](Expr x, Expr y) { return max(sqrt(y * y) - 10.0 * (x + 0.3), x - 0.5); },
      [](Expr x, Expr y) { return min(make(Op::cbrt, y * x) - x, y); },
      [](Expr x, Expr y) { return abs(sqrt(y * y) + x) - sqrt(y * y); },
  };
  for (const Formula& formula : formulas)
    for (const Inclusion& inclusion : inclusions())
      for (const Box1 y : {Box1{0, 0}, {0.1, 0.2}}) {
        if (may_refuse(inclusion, program_of(formula))) continue;
        const Enclosed enclosed(formula, *inclusion.enclose);
        const Bounds bounds = enclosed.over({-1, 2}, y);
        for (const double x : {-1.0, -0.3, 0.0, 0.5, 1.0, 2.0}) {
          const Enclosure value = exact_values(enclosed.f(), std::array{x, y.lo})[0];
          if (value.lo > value.hi) continue;  // not defined
          EXPECT_TRUE(bounds.lo <= value.hi && value.lo <= bounds.hi) << inclusion.name << ' ' << x;
        }
      }
}

TEST(Forms, boxes_may_be_unbounded_or_a_point) {
  const Formula general = [](Expr x, Expr y) { return x * x + exponential(-y) - x; };
  const Formula polynomial = [](Expr x, Expr y) { return x * x - x * y; };
  for (const Inclusion& inclusion : inclusions())
    for (const Type type : {f32, f64}) {
      const Enclosed form(inclusion.enclose == bernstein_form ? polynomial : general, *inclusion.enclose,
                          type);
      for (const Box1 x :
           {Box1{-infinity, infinity}, {0, infinity}, {-infinity, -1}, {0.1, 0.1}, {1e300, 1e308}})
        for (const Box1 y : {Box1{-infinity, infinity}, {3, 3}, {-1e-300, 1e-310}}) {
          const Bounds bounds = form.over(x, y);
          EXPECT_LE(bounds.lo, bounds.hi) << inclusion.name << x.lo << ' ' << y.lo;
        }
    }
}

}  // namespace
}  // namespace imp::test
