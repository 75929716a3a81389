// Rays with known roots: a certified answer is never wrong, and most answers are certified.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "tests/support/cast.h"
#include "tests/support/effort.h"

namespace imp {
namespace {

using test::Answer;
using test::Caster;

// What is wrong with an answer, or nothing. Of roots closer together than a certified hit need tell apart, some
// first ones must be odd in number: then f changes its sign behind them.
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
  int roots = 0;
  bool crosses = false;
  for (const test::Root& root : ray.roots)
    if (root.t - first <= tolerance) crosses |= (roots += root.multiplicity) % 2 == 1;
  return crosses ? "" : fmt::format("hit {}, which is no crossing", answer.t);
}

struct Count {
  int easy = 0, decided = 0;
};

Count cast_all(const test::SurfaceEntry& entry, const KernelOptions& options,
               const Search& search = searches().front()) {
  const Model model = test::model_of(entry);
  Diagnostics diagnostics;
  if (!cast_program(model.surfaces[0], search, inclusions().front(), {}, options.precision, diagnostics))
    return {};  // tests/runtime/search/strategies_test.cpp: what is refused

  const auto answers = Caster(model, options, {}, {}, inclusions().front(), search)(test::rays_of(entry));
  Count count;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const test::RayRecord& ray = entry.rays[i];
    EXPECT_EQ(mistake(ray, answers[i]), "") << entry.id << ", ray " << i << ", " << search.name;
    if (ray.unresolved || ray.zero_on_ray || is_hard(ray)) continue;
    ++count.easy;
    if (answers[i].verdict != verdict_undecided) ++count.decided;
  }
  return count;
}

// What a strategy is to decide of the rays that are not hard. Making kernels is what takes time, so some are tried
// on every third surface only.
struct Expected {
  const char* search;
  Type type;
  double share;
  std::size_t every = 1;
};

void PrintTo(const Expected& expected, std::ostream* out) { *out << expected.search; }

class Strategy_ : public testing::TestWithParam<Expected> {};

TEST_P(Strategy_, certified_answers_are_right) {
  const Expected& expected = GetParam();
  Count total;
  const auto entries = test::all_entries();
  for (std::size_t i = 0; i < entries.size(); i += test::sanitized ? 11 : expected.every) {
    const Count count = cast_all(*entries[i], {.precision = expected.type}, *search_named(expected.search));
    total.easy += count.easy;
    total.decided += count.decided;
  }
  if (!test::sanitized) { EXPECT_GT(static_cast<double>(total.decided) / total.easy, expected.share); }
}

// What stackless leaves is listed, with the reason, in docs/decisions/search.md.
INSTANTIATE_TEST_SUITE_P(Strategies, Strategy_,
                         testing::Values(Expected{"stackless", f32, 0.83},
                                         Expected{"stackless", f64, 0.98, 3}, Expected{"isolate", f32, 0.9},
                                         Expected{"isolate", f64, 0.98, 3},
                                         Expected{"bernstein", f32, 0.95, 3},
                                         Expected{"polynomial", f32, 0.95, 3},
                                         Expected{"segment", f32, 0.5, 3}, Expected{"newton", f32, 0.95, 3},
                                         Expected{"newton", f64, 0.98, 6}));

// Of the whole catalogue; no kernel is made for that.
TEST(Search, bernstein_refuses_what_is_no_polynomial) {
  int refused = 0;
  for (const test::SurfaceEntry* entry : test::all_entries()) {
    Diagnostics diagnostics;
    refused += !cast_program(test::model_of(*entry).surfaces[0], *search_named("bernstein"),
                             inclusions().front(), {}, f32, diagnostics);
  }
  EXPECT_EQ(refused, 19);
}

TEST(Search, certified_answers_are_right_by_the_interpreter) {
  for (const char* id : {"sphere", "steiner", "torus", "kummer_16"})
    cast_all(test::entry_named(id), {.backend = Backend::interpreter});
}

// As in the papers: nothing is certain then, but it runs, and finds what there is on a simple surface.
TEST(Search, rounding_to_nearest_finds_a_sphere) {
  const test::SurfaceEntry& entry = test::entry_named("sphere");
  const Caster cast(test::model_of(entry), {.outward = false}, {}, {}, *inclusion_named("ia"));
  const auto answers = cast(test::rays_of(entry));
  for (std::size_t i = 0; i < answers.size(); ++i)
    EXPECT_TRUE(is_hard(entry.rays[i]) || (answers[i].verdict == verdict_hit) == !entry.rays[i].roots.empty())
        << i;
}

}  // namespace
}  // namespace imp
