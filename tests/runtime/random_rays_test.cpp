// The reference that searches are compared with is right itself, and searches agree with it on random rays:
// `imp_prove searches` tries more of them.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "tests/support/judge.h"
#include "tests/support/random_rays.h"
#include "tests/support/ways.h"

namespace imp {
namespace {

using test::Answer;
using test::DenseRoots;
using test::Judge;
using test::Judgement;
using test::Ray;

// On rays with known roots.
TEST(DenseRoots, are_the_first_roots) {
  int easy = 0, known_easy = 0;
  for (const char* id :
       {"sphere", "steiner", "tangle", "kummer_16", "barth_sextic", "labs_septic", "chmutov_14",
        "superquadric_knoll", "blinn_blobby", "sin_blob", "superquadric_twist"}) {
    const test::SurfaceEntry& entry = test::entry_named(id);
    const test::DenseSearch search(test::model_of(entry));
    for (std::size_t i = 0; const Ray& ray : test::rays_of(entry)) {
      const test::RayRecord& known = entry.rays[i++];
      if (known.unresolved || known.zero_on_ray) continue;
      const DenseRoots found = search(ray);
      const std::string where = fmt::format("{}, ray {}", id, i - 1);
      known_easy += is_hard(known) ? 0 : 1;
      if (!found.easy) continue;
      ++easy;
      EXPECT_EQ(found.crossing.has_value(), !known.roots.empty()) << where;
      if (!found.crossing || known.roots.empty()) continue;
      EXPECT_LE(found.crossing->lo, known.roots[0].t + 1e-8) << where;
      EXPECT_GE(found.crossing->hi, known.roots[0].t - 1e-8) << where;
    }
  }
  EXPECT_GT(easy, 0.9 * known_easy) << "few rays are called hard";
}

constexpr const char* two_balls = "((x-2)^2 + y^2 + z^2 - 1)*((x+2)^2 + y^2 + z^2 - 1)";

Answer hit(double t) { return {verdict_hit, t, {}, 0}; }
Answer miss() { return {verdict_miss, NAN, {}, 0}; }

TEST(Judge, tells_wrong_answers_from_right_ones) {
  const Judge judge(test::model_of(two_balls));
  const auto judged = [&](const Ray& ray, const Answer& answer) {
    return judge(ray, judge.roots(ray), answer);
  };

  const Ray through{{-5, 0.25, 0}, {1, 0, 0}, 0, 10};
  const double half = std::sqrt(1 - 0.0625);
  EXPECT_EQ(judged(through, hit(3 - half)), Judgement::right);
  EXPECT_EQ(judged(through, hit(3 + half)), Judgement::wrong) << "not the first";
  EXPECT_EQ(judged(through, hit(7 - half)), Judgement::wrong) << "nor that";
  EXPECT_EQ(judged(through, hit(3 - half - 1e-3)), Judgement::wrong) << "before it";
  EXPECT_EQ(judged(through, hit(NAN)), Judgement::wrong);
  EXPECT_EQ(judged(through, miss()), Judgement::wrong);
  EXPECT_EQ(judged(through, {verdict_undecided, NAN, {}, 0}), Judgement::undecided);

  const Ray beside{{-5, 1.5, 0}, {1, 0, 0}, 0, 10};
  EXPECT_EQ(judged(beside, miss()), Judgement::right);
  EXPECT_EQ(judged(beside, hit(3)), Judgement::wrong);

  const Ray touching{{-5, 1, 0}, {1, 0, 0}, 0, 10};
  EXPECT_NE(judged(touching, miss()), Judgement::right) << "a touch is a root";
  for (int k = 10; k < 50; k += 3) {  // two roots 2^(1-k/2) apart, or none
    const double gap = std::ldexp(1.0, -k), root = 3 - std::sqrt(gap * (2 - gap));
    const Ray within{{-5, 1 - gap, 0}, {1, 0, 0}, 0, 10}, without{{-5, 1 + gap, 0}, {1, 0, 0}, 0, 10};
    EXPECT_EQ(judged(within, hit(root)), Judgement::right) << k;
    EXPECT_EQ(judged(within, miss()), Judgement::wrong) << k;
    EXPECT_NE(judged(without, miss()), Judgement::wrong) << k;
    if (k < 40) { EXPECT_EQ(judged(without, miss()), Judgement::right) << k; }
    EXPECT_NE(judged(without, hit(3)), Judgement::right) << k;
  }
}

TEST(Judge, takes_no_pole_for_a_root) {
  const Judge judge(test::model_of("1/x + y"));
  const Ray across{{-1, 0, 0}, {1, 0, 0}, 0, 3}, below{{-1, -1, 0}, {1, 0, 0}, 0, 3};
  EXPECT_NE(judge(across, judge.roots(across), miss()), Judgement::wrong);
  EXPECT_NE(judge(across, judge.roots(across), hit(1)), Judgement::right);
  EXPECT_EQ(judge(below, judge.roots(below), miss()), Judgement::wrong) << "1/x = 1, behind the pole";
  EXPECT_NE(judge(below, judge.roots(below), hit(2)), Judgement::wrong);
}

class RandomRays : public testing::TestWithParam<const char*> {};

TEST_P(RandomRays, are_answered_right) {
  const test::SurfaceEntry& entry = test::entry_named(GetParam());
  const Model model = test::model_of(entry);
  const Judge judge(model, 1024);
  test::RandomRays random(entry.domain, 1);
  std::vector<Ray> rays;
  std::vector<DenseRoots> roots;
  for (std::size_t i = 0; i < test::effort(400); ++i) {
    rays.push_back(random.next(judge.dense()));
    roots.push_back(judge.roots(rays.back()));
  }
  for (const test::Way& way : test::ways({"auto"})) {
    const auto cast = test::caster(model, way);
    if (!cast) continue;  // strategies may refuse a surface
    const auto answers = (*cast)(rays);
    for (std::size_t i = 0; i < rays.size(); ++i)
      EXPECT_NE(judge(rays[i], roots[i], answers[i]), Judgement::wrong)
          << way.name() << ": " << test::to_text(rays[i]) << ": " << answers[i].verdict << " at "
          << answers[i].t;
  }
}

INSTANTIATE_TEST_SUITE_P(Surfaces, RandomRays,
                         testing::Values("steiner", "tangle", "torus", "kummer_16", "barth_sextic",
                                         "klein_bottle", "blinn_blobby", "superquadric_round"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace imp
