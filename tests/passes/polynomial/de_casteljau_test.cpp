// Splitting encloses the exact coefficients over both parts.
#include "passes/polynomial/de_casteljau.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/boxes.h"
#include "tests/support/evaluate.h"
#include "tests/support/make.h"
#include "tests/support/rational.h"

namespace imp::test {
namespace {

struct Exact {
  std::vector<Rational> left, right;
};

Exact exact_split(std::vector<Rational> row, const Rational& at) {
  Exact result{row, row};
  for (std::size_t level = 0; !row.empty(); ++level, row.pop_back()) {
    result.left[level] = row.front();
    result.right[row.size() - 1] = row.back();
    for (std::size_t i = 0; i + 1 < row.size(); ++i) row[i] = (1 - at) * row[i] + at * row[i + 1];
  }
  return result;
}

enum class Cut : std::uint8_t { anywhere, in_the_middle, at_a_number };

Halves split_by(Cut cut, std::span<const Interval> b, Expr at) {
  if (cut == Cut::in_the_middle) return split_in_the_middle(b);
  return cut == Cut::anywhere ? split(b, point(at, {true, true})) : split_at(b, at, 1.0 - at);
}

// Coefficients are boxes, of which the exact ones are any points.
void expect_enclosed(std::size_t count, Type type, Cut cut) {
  Program kernel{.name = "kernel"};
  std::vector<Interval> b;
  for (std::size_t i = 0; i < count; ++i) {
    const Expr lo = input(kernel, "lo", type), hi = input(kernel, "hi", type);
    b.push_back(interval(-lo, hi));
  }
  const Expr at = input(kernel, "at", type);
  const Halves halves = split_by(cut, b, at);
  for (const auto* half : {&halves.left, &halves.right})
    for (const Interval& x : *half) output(kernel, "nlo", x.nlo), output(kernel, "hi", x.hi);
  const auto compiled = interpret(kernel);

  Boxes boxes(count + 100 * static_cast<std::size_t>(cut));
  const auto number = [&](double x) {
    x = std::clamp(x, -0x1p100, 0x1p100);
    return type == f32 ? static_cast<double>(static_cast<float>(x)) : x;
  };
  for (int i = 0; i < 150; ++i) {
    std::vector<double> numbers;
    std::vector<Rational> exact;
    for (std::size_t k = 0; k < count; ++k) {
      const Box1 box = boxes.pick(2) ? boxes.within(-1, 1) : boxes.box();
      numbers.insert(numbers.end(), {number(box.lo), number(box.hi)});
      exact.emplace_back(number(boxes.inside(box)));
    }
    double share = boxes.pick(6) == 0 ? 1.0 : number(boxes.between(0, 1));
    if (cut == Cut::in_the_middle) share = 0.5;
    if (cut == Cut::at_a_number) share = std::floor(share * 0x1p24) * 0x1p-24;  // 1 - share is exact
    numbers.push_back(share);
    const Exact parts = exact_split(exact, Rational(share));
    const auto found = evaluate(*compiled, numbers);
    for (std::size_t k = 0; k < count; ++k) {
      ASSERT_TRUE(lies_in(parts.left[k], -found[2 * k], found[2 * k + 1])) << k << " of " << count;
      const std::size_t at_right = 2 * (count + k);
      ASSERT_TRUE(lies_in(parts.right[k], -found[at_right], found[at_right + 1])) << k << " of " << count;
    }
  }
}

TEST(DeCasteljau, encloses_both_parts) {
  for (const Type type : {f32, f64})
    for (const std::size_t count : {1u, 2u, 3u, 5u, 9u, 13u})
      for (const Cut cut : {Cut::anywhere, Cut::in_the_middle, Cut::at_a_number})
        expect_enclosed(count, type, cut);
}

TEST(DeCasteljau, is_exact_where_no_rounding_is) {
  Program kernel{.name = "kernel"};
  std::vector<Interval> b;
  for (const double value : {1.0, -2.0, 4.0}) b.push_back(point(number(kernel, value)));  // x^2 over [-1, 2]
  const Halves halves = split_in_the_middle(b);
  for (const auto* half : {&halves.left, &halves.right})
    for (const Interval& x : *half) output(kernel, "lo", x.lo()), output(kernel, "hi", x.hi);
  EXPECT_EQ(evaluate(kernel, {}),
            (std::vector<double>{1, 1, -0.5, -0.5, 0.25, 0.25, 0.25, 0.25, 1, 1, 4, 4}));
}

}  // namespace
}  // namespace imp::test
