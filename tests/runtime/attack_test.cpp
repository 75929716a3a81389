// Nothing that was ever answered wrong is answered so again, and a part of the attack finds nothing:
// `imp_prove attack` goes on for as long as it is told.
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/attack.h"
#include "tests/support/ball.h"
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

class AttackCorpus : public testing::TestWithParam<std::size_t> {};

TEST_P(AttackCorpus, is_answered_right) {
  const AttackCase attack = corpus()[GetParam()];
  const auto [proof, answer] = test::judged(attack);
  EXPECT_NE(proof, Proof::wrong) << to_text(attack) << '\n' << answer;
}

INSTANTIATE_TEST_SUITE_P(Attack, AttackCorpus, testing::Range<std::size_t>(0, corpus().size()));

constexpr std::size_t parts = 16;

class AttackSample : public testing::TestWithParam<std::size_t> {};

TEST_P(AttackSample, is_answered_right) {
  test::AttackTotal total;
  for (std::size_t i = 0; i < test::effort(6); ++i) total.add(test::attack(GetParam() + parts * i));
  for (const AttackCase& wrong : total.wrong)
    ADD_FAILURE() << to_text(wrong) << '\n' << test::judged(wrong).text;
  for (const test::AttackCount& count : {total.by[0], total.by[1]})
    EXPECT_GE(count.right + 2, count.certified / 2) << "the reference proves too little";
}

INSTANTIATE_TEST_SUITE_P(Attack, AttackSample, testing::Range<std::size_t>(0, parts));

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

// Sets hold the values at the places they are of, and these are the values of the formula that was compiled.
TEST(RealFunction, holds_the_values_of_a_formula) {
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < test::effort(2000); ++seed) {
    test::RandomScenes scenes(seed);
    const test::Scene scene = scenes.next();
    const auto meaning = test::meaning_of(scene);
    if (!meaning) continue;
    test::RandomQuestions questions(seed, scenes.aim());
    const test::RealBox box = questions.box();
    std::vector<test::RealSet> sides, place;
    std::vector<double> numbers;
    for (std::size_t i = 0; const double x : questions.inside(box)) {
      sides.push_back({test::Real(box[2 * i]), test::Real(box[2 * i + 1])});
      place.push_back({test::Real(x), test::Real(x)});
      numbers.push_back(x), ++i;
    }
    for (const double x : meaning->uniforms) {
      sides.push_back({test::Real(x), test::Real(x)}), place.push_back(sides.back());
      numbers.push_back(x);
    }
    const test::RealFunction& f = meaning->functions[0];
    const test::Outcome over = f(sides), at = f(place);
    if (!at.defined) continue;
    EXPECT_FALSE(over.nowhere) << seed;
    EXPECT_TRUE(over.lo <= at.hi && at.lo <= over.hi) << seed;
    const test::Ball ball = test::ball_values(meaning->model.surfaces[0].f, numbers).front();
    if (!ball.is(test::Ball::State::number)) continue;
    test::Real lo, hi;
    arb_get_interval_arf(lo.get(), hi.get(), ball.get(), test::Real::precision);
    EXPECT_TRUE(at.lo <= hi && lo <= at.hi)
        << seed << ": " << to_text(scene) << " at " << fmt::format("{}", fmt::join(numbers, ",")) << " is "
        << lo.nearest() << ", not " << at.lo.nearest();
    ++compared;
  }
  EXPECT_GT(compared, test::effort(1000));
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
