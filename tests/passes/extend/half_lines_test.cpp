// Division through zero: both half-lines hold every solution of n = d x, and no more than they must.
#include "passes/extend/half_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/boxes.h"
#include "tests/support/evaluate.h"
#include "tests/support/make.h"

namespace imp::test {
namespace {

struct HalfLine {
  bool empty;
  double lo, hi;
};

bool operator==(const HalfLine& a, const HalfLine& b) {
  return a.empty == b.empty && (a.empty || (a.lo == b.lo && a.hi == b.hi));
}
void PrintTo(const HalfLine& line, std::ostream* out) {
  *out << (line.empty ? "empty" : to_text(Box1{line.lo, line.hi}));
}

constexpr HalfLine none{true, 0, 0}, all_below{false, -infinity, 0}, all_above{false, 0, infinity};

// The rule as a Program over boxes of doubles, which are narrowed outward in float.
class HalfLinesOf : public testing::TestWithParam<Type> {
 protected:
  HalfLinesOf() {
    Program p{.name = "half_lines"};
    const auto operand = [&](const std::string& name) {
      const Expr nlo = -input(p, name + "lo", f64), hi = input(p, name + "hi", f64);
      return GetParam() == f32 ? interval(narrow_up(nlo), narrow_up(hi)) : interval(nlo, hi);
    };
    const Interval n = operand("n"), d = operand("d");
    const auto [below, above] = half_lines(n, d);
    for (const Interval& line : {below, above}) {
      output(p, "empty" + std::to_string(p.outputs.size()), line.empty);
      output(p, "lo" + std::to_string(p.outputs.size()), line.lo());
      output(p, "hi" + std::to_string(p.outputs.size()), line.hi);
    }
    kernel_ = interpret(p);
  }

  std::array<HalfLine, 2> solve(Box1 n, Box1 d) const {
    const auto v = evaluate(*kernel_, std::array{n.lo, n.hi, d.lo, d.hi});
    return {HalfLine{v[0] != 0, v[1], v[2]}, HalfLine{v[3] != 0, v[4], v[5]}};
  }

 private:
  std::unique_ptr<Kernel> kernel_;
};

// Whether n/d is in the line, exactly: fma keeps the sign of lo d - n.
bool holds(const HalfLine& line, double n, double d) {
  if (line.empty) return false;
  const double turn = d < 0 ? -1 : 1;
  const auto beyond = [&](double end) { return turn * std::fma(end, d, -n); };  // the sign of end - n/d
  return (line.lo == -infinity || beyond(line.lo) <= 0) && (line.hi == infinity || beyond(line.hi) >= 0);
}

TEST_P(HalfLinesOf, hold_every_solution) {
  Boxes boxes(0x2000);
  int gaps = 0;
  for (int i = 0; i < 60000; ++i) {
    const Box1 n = boxes.box(), d = boxes.box();
    const auto [below, above] = solve(n, d);
    gaps += !below.empty && !above.empty && below.hi < above.lo;
    for (int k = 0; k < 6; ++k) {
      const double pn = boxes.inside(n), pd = boxes.inside(d);
      if (pd != 0) {
        ASSERT_TRUE(holds(below, pn, pd) || holds(above, pn, pd))
            << to_text(n) << " / " << to_text(d) << " at " << pn << " / " << pd;
      } else if (pn == 0) {  // every x
        ASSERT_EQ(below, all_below) << to_text(n) << " / " << to_text(d);
        ASSERT_EQ(above, all_above) << to_text(n) << " / " << to_text(d);
      }
    }
  }
  EXPECT_GT(gaps, 1000);
}

// Ends are those of the solutions, rounded once. The least and the greatest lie at corners, or where d is next to 0.
TEST_P(HalfLinesOf, hold_no_more_than_they_must) {
  if (GetParam() == f32) return;  // the boxes are no floats
  Boxes boxes(0x1788);
  for (int i = 0; i < 60000; ++i) {
    const Box1 n = boxes.box(), d = boxes.box();
    const auto lines = solve(n, d);
    for (const double side : {-1.0, 1.0}) {
      const HalfLine& line = lines[side > 0];
      double least = infinity, greatest = 0;  // |x|
      const bool zero_n = n.lo <= 0 && 0 <= n.hi, zero_d = d.lo <= 0 && 0 <= d.hi;
      if (zero_n) least = 0;
      if (zero_n && zero_d) greatest = infinity;
      for (const double a : {n.lo, n.hi})
        for (const double b : {d.lo, d.hi}) {
          const double x = side * a / b;
          if (b == 0 || std::isnan(x) || (a != 0 && (std::signbit(a) != std::signbit(b)) == (side > 0)))
            continue;
          least = std::min(least, x);
          greatest = std::max(greatest, zero_d ? infinity : x);
        }
      const auto text = to_text(n) + " / " + to_text(d);
      ASSERT_EQ(line.empty, least == infinity && greatest == 0) << text;
      if (line.empty) continue;
      const double near = side > 0 ? line.lo : -line.hi, far = side > 0 ? line.hi : -line.lo;
      ASSERT_GE(near, std::nextafter(least, 0.0)) << text;
      ASSERT_LE(far, std::nextafter(greatest, infinity)) << text;
    }
  }
}

TEST_P(HalfLinesOf, are_known_by_heart) {
  const auto solutions = [](HalfLine below, HalfLine above) { return std::array{below, above}; };
  EXPECT_EQ(solve({1, 2}, {-1, 4}), solutions({false, -infinity, -1}, {false, 0.25, infinity}));
  EXPECT_EQ(solve({-2, -1}, {-1, 4}), solutions({false, -infinity, -0.25}, {false, 1, infinity}));
  EXPECT_EQ(solve({1, 2}, {0, 4}), solutions(none, {false, 0.25, infinity}));
  EXPECT_EQ(solve({1, 2}, {-4, 0}), solutions({false, -infinity, -0.25}, none));
  EXPECT_EQ(solve({1, 2}, {0, 0}), solutions(none, none));
  EXPECT_EQ(solve({1, 2}, {2, 4}), solutions(none, {false, 0.25, 1}));
  EXPECT_EQ(solve({-1, 2}, {2, 4}), solutions({false, -0.5, 0}, {false, 0, 1}));
  EXPECT_EQ(solve({-1, 2}, {-4, -2}), solutions({false, -1, 0}, {false, 0, 0.5}));
  EXPECT_EQ(solve({0, 0}, {2, 4}), solutions({false, 0, 0}, {false, 0, 0}));
  EXPECT_EQ(solve({-1, 2}, {-1, 1}), solutions(all_below, all_above));
  EXPECT_EQ(solve({0, 0}, {0, 0}), solutions(all_below, all_above));
  EXPECT_EQ(solve({1, infinity}, {-infinity, infinity}), solutions(all_below, all_above));
}

TEST_P(HalfLinesOf, nan_keeps) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::array all{all_below, all_above};
  EXPECT_EQ(solve({nan, nan}, {-1, 1}), all);
  EXPECT_EQ(solve({1, 2}, {nan, nan}), all);
  EXPECT_EQ(solve({nan, nan}, {nan, nan}), all);
  EXPECT_EQ(solve({1, nan}, {2, 4}), (std::array{none, HalfLine{false, 0.25, infinity}}));
  EXPECT_EQ(solve({nan, 2}, {2, 4}), (std::array{HalfLine{false, -infinity, 0}, HalfLine{false, 0, 1}}));
}

INSTANTIATE_TEST_SUITE_P(precision, HalfLinesOf, testing::Values(f32, f64),
                         [](const auto& test) { return to_text(test.param); });

}  // namespace
}  // namespace imp::test
