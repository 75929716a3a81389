// Nothing that was ever answered wrong is answered so again, and a part of the attack finds nothing: `imp_prove
// attack` goes on for as long as it is told.
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/attack.h"
#include "tests/support/effort.h"

namespace imp {
namespace {

using test::AttackCase;
using test::Proof;

std::vector<AttackCase> corpus() {
  std::vector<AttackCase> cases;
  std::ifstream file(std::string(IMP_TEST_DATA) + "/attack.txt");
  for (std::string line; std::getline(file, line);)
    if (!line.empty() && line[0] != '#') cases.push_back(test::read_attack(line));
  return cases;
}

class Corpus : public testing::TestWithParam<std::size_t> {};

TEST_P(Corpus, is_answered_right) {
  const AttackCase attack = corpus()[GetParam()];
  const auto [proof, answer] = test::judged(attack);
  EXPECT_NE(proof, Proof::wrong) << to_text(attack) << '\n' << answer;
}

INSTANTIATE_TEST_SUITE_P(Attack, Corpus, testing::Range<std::size_t>(0, corpus().size()));

constexpr std::size_t parts = 16;

class Sample : public testing::TestWithParam<std::size_t> {};

TEST_P(Sample, is_answered_right) {
  test::AttackTotal total;
  for (std::size_t i = 0; i < test::effort(6); ++i) total.add(test::attack(GetParam() + parts * i));
  for (const AttackCase& wrong : total.wrong)
    ADD_FAILURE() << to_text(wrong) << '\n' << test::judged(wrong).text;
  for (const test::AttackCount& count : {total.by[0], total.by[1]})
    EXPECT_GT(count.right, count.certified / 2) << "the reference proves too little";
}

INSTANTIATE_TEST_SUITE_P(Attack, Sample, testing::Range<std::size_t>(0, parts));

// The reference itself, on answers that are made up.
TEST(RayTruth, tells_wrong_answers_from_right_ones) {
  const auto proof = [](const char* formula, const test::Ray& ray, double verdict, double t) {
    const test::RealFunction f(test::read_expression(formula), {"x", "y", "z"});
    const test::RayTruth truth(f, ray, {});
    return test::proof_of(std::span(&truth, 1), ray, {verdict, t, {}, 0});
  };
  const test::Ray ray{{0, 0, 0}, {1, 0, 0}, -2, 2};
  EXPECT_EQ(proof("x^2 - 1", ray, verdict_hit, -1), Proof::right);
  EXPECT_EQ(proof("x^2 - 1", ray, verdict_hit, -1 + 3e-5), Proof::right);
  EXPECT_EQ(proof("x^2 - 1", ray, verdict_hit, -1 + 5e-5), Proof::wrong) << "beside the root";
  EXPECT_EQ(proof("x^2 - 1", ray, verdict_hit, 1), Proof::wrong) << "not the first";
  EXPECT_EQ(proof("x^2 - 1", ray, verdict_hit, -3), Proof::wrong) << "off the ray";
  EXPECT_EQ(proof("x^2 - 1", ray, verdict_miss, NAN), Proof::wrong);
  EXPECT_EQ(proof("x^2 + 1", ray, verdict_miss, NAN), Proof::right);
  EXPECT_EQ(proof("x^2", ray, verdict_hit, 0), Proof::wrong) << "a touch";
  EXPECT_EQ(proof("x^2", ray, verdict_miss, NAN), Proof::wrong) << "a zero at a place that is met";
  EXPECT_EQ(proof("1/x", ray, verdict_hit, 0), Proof::wrong) << "a pole";
  EXPECT_EQ(proof("1/x", ray, verdict_miss, NAN), Proof::right);
  EXPECT_EQ(proof("if(x < 0.3, -1, 1)", ray, verdict_hit, 0.3), Proof::wrong) << "a jump";
  EXPECT_EQ(proof("if(x < 0.3, -1, 1)", ray, verdict_miss, NAN), Proof::right);
  EXPECT_EQ(proof("tan(x)", ray, verdict_miss, NAN), Proof::wrong);
  EXPECT_EQ(proof("log(x - 5)^0 - 1", ray, verdict_hit, 0), Proof::wrong) << "no value";
  EXPECT_EQ(proof("log(x - 5)^0 - 1", ray, verdict_miss, NAN), Proof::right);
  EXPECT_EQ(proof("x^(0.3/0.1) + 0.125", ray, verdict_hit, -0.5), Proof::right);
  EXPECT_EQ(proof("x^0.3 + 0.125", ray, verdict_hit, -0.5), Proof::wrong);
  EXPECT_EQ(proof("min(log(x), x + 1)", ray, verdict_hit, -1), Proof::right)
      << "the second where there is no first";
}

TEST(Expression, is_read_as_it_is_written) {
  for (const char* text :
       {"-x^2 + 3*(y - z)/2", "(x + 1)^-y^2", "if(not (x < 1 and y > 2) or z >= 0, 1, a - (b - c))",
        "sum(i, 1, 3, x^i)*|y|", "2*-x - -1.5e-3"}) {
    const test::Expression e = test::read_expression(text);
    EXPECT_EQ(test::read_expression(to_text(e)), e) << text;
  }
}

}  // namespace
}  // namespace imp
