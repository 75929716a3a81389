// The test vectors of IEEE 1788: the interval extension holds every right answer, in both types, and
// never says continuous where a decoration does not.
#include "tests/support/itf1788.h"

#include <gtest/gtest.h>

namespace imp::test {
namespace {

const std::vector<TestVector>& vectors() {
  static const auto all = load_test_vectors(std::filesystem::path(IMP_TEST_DATA) / "itf1788.txt");
  return all;
}

class Itf1788 : public testing::TestWithParam<Type> {
 protected:
  std::map<std::string, TrialCount> counts = try_vectors(vectors(), GetParam());
};

TEST_P(Itf1788, every_vector_is_enclosed_and_no_flag_says_too_much) {
  std::size_t tried = 0, flags = 0;
  for (const auto& [op, count] : counts) {
    EXPECT_EQ(count.missed, 0u) << op << ", the first: " << count.first;
    EXPECT_EQ(count.overclaimed, 0u) << op << ", the first: " << count.first;
    tried += count.tried, flags += count.flags;
  }
  EXPECT_GT(tried, 3700u);
  EXPECT_GT(flags, 200u);
}

// One rounding is as tight as can be, an elementary function but for its bound. Wider are the corners
// of pow and atan2, where the box touches what the function jumps at, and tan beside its pole.
TEST_P(Itf1788, is_no_wider_than_it_was) {
  for (const char* op : {"abs", "add", "ceil", "div", "floor", "fma", "max", "min", "mul", "neg", "pos",
                         "recip", "sign", "sqr", "sub"})
    EXPECT_EQ(counts.at(op).exact, counts.at(op).measured) << op;
  for (const auto& [op, count] : counts) {
    EXPECT_LE(count.most, 24) << op;
    if (op != "pow" && op != "atan2" && op != "tan") {
      EXPECT_EQ(count.wide, 0u) << op;
      if (GetParam() == f64) {
        EXPECT_EQ(count.shy, 0u) << op;  // floats may leave the domain
      }
    }
  }
}

// The rule that no op of a formula spells.
TEST(Itf1788, intersections) {
  Program program{.name = "intersection"};
  std::array<Expr, 4> ends;
  for (std::size_t i = 0; i < 4; ++i) ends[i] = input(program, std::string(1, "abcd"[i]), f64);
  Interval a = interval(-ends[0], ends[1]), b = interval(-ends[2], ends[3]);
  a.empty = !(ends[0] <= ends[1]), b.empty = !(ends[2] <= ends[3]);
  const Interval both = intersect(a, b);
  output(program, "lo", both.lo());
  output(program, "hi", both.hi);
  output(program, "empty", both.empty);
  std::size_t tried = 0;
  for (const TestVector& vector : vectors()) {
    if (vector.op != "intersection") continue;
    const Box1 x = vector.operands[0].box, y = vector.operands[1].box, right = vector.results[0].box;
    const auto found = evaluate(program, {x.lo, x.hi, y.lo, y.hi});
    EXPECT_EQ(found[2] != 0, vector.results[0].empty()) << vector.text;
    if (!vector.results[0].empty()) {
      EXPECT_EQ(found[0], right.lo) << vector.text;
      EXPECT_EQ(found[1], right.hi) << vector.text;
    }
    ++tried;
  }
  EXPECT_GT(tried, 5u);
}

INSTANTIATE_TEST_SUITE_P(precision, Itf1788, testing::Values(f32, f64),
                         [](const auto& test) { return to_text(test.param); });

}  // namespace
}  // namespace imp::test
