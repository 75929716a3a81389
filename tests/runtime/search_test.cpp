// Rays with known roots: a certified answer is never wrong, and most answers are certified.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "tests/support/cast.h"

namespace imp {
namespace {

using test::Answer;
using test::Caster;

// What is wrong with an answer, or nothing. An odd number of roots closer together than a certified
// hit can tell apart is one crossing.
std::string mistake(const test::RayRecord& ray, const Answer& answer) {
  if (answer.verdict == verdict_undecided) return "";
  if (ray.zero_on_ray) return "certified, but f is 0 along the ray";
  const double tolerance = 2e-5 * (ray.t1 - ray.t0);
  if (answer.verdict == verdict_miss)
    return ray.roots.empty() ? "" : fmt::format("missed {}", ray.roots[0].t);
  if (ray.unresolved) return "";
  if (ray.roots.empty()) return fmt::format("hit {}, but there is nothing", answer.t);
  const double first = ray.roots[0].t;
  if (!(std::abs(answer.t - first) <= tolerance)) return fmt::format("hit {}, not {}", answer.t, first);
  int crossings = 0;
  for (const test::Root& root : ray.roots)
    if (root.t - first <= tolerance) crossings += root.multiplicity;
  return crossings % 2 == 1 ? "" : fmt::format("hit {}, which is no crossing", answer.t);
}

struct Count {
  int easy = 0, decided = 0;
};

Count cast_all(const test::SurfaceEntry& entry, const KernelOptions& options) {
  const auto answers = Caster(test::model_of(entry), options)(test::rays_of(entry));
  Count count;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const test::RayRecord& ray = entry.rays[i];
    EXPECT_EQ(mistake(ray, answers[i]), "") << entry.id << ", ray " << i;
    if (ray.unresolved || ray.zero_on_ray || is_hard(ray)) continue;
    ++count.easy;
    if (answers[i].verdict != verdict_undecided) ++count.decided;
  }
  return count;
}

double share_decided(const KernelOptions& options) {
  Count total;
  for (const test::SurfaceEntry* entry : test::all_entries()) {
    const Count count = cast_all(*entry, options);
    total.easy += count.easy;
    total.decided += count.decided;
  }
  return static_cast<double>(total.decided) / total.easy;
}

// The others are listed, with the reason, in docs/decisions/search.md.
TEST(Search, certified_answers_are_right_in_float) { EXPECT_GT(share_decided({}), 0.83); }

// 98.9 %.
TEST(Search, certified_answers_are_right_in_double) { EXPECT_GT(share_decided({.precision = f64}), 0.98); }

TEST(Search, certified_answers_are_right_by_the_interpreter) {
  for (const char* id : {"sphere", "steiner", "torus", "kummer_16"})
    cast_all(test::entry_named(id), {.backend = Backend::interpreter});
}

// As in the papers: nothing is certain then, but it runs, and finds what there is on a simple surface.
TEST(Search, rounding_to_nearest_finds_a_sphere) {
  const test::SurfaceEntry& entry = test::entry_named("sphere");
  const auto answers = Caster(test::model_of(entry), {.outward = false})(test::rays_of(entry));
  for (std::size_t i = 0; i < answers.size(); ++i)
    EXPECT_TRUE(is_hard(entry.rays[i]) || (answers[i].verdict == verdict_hit) == !entry.rays[i].roots.empty())
        << i;
}

}  // namespace
}  // namespace imp
