// A ray's answer is its own: what else is in its packet, in which order, and which backend casts it
// change nothing.
#include <gtest/gtest.h>

#include "tests/support/evaluate.h"
#include "tests/support/random.h"
#include "tests/support/ways.h"

namespace imp {
namespace {

using test::Answer;
using test::Caster;
using test::Ray;
using test::same_bits;

void expect_same(const Answer& a, const Answer& b, const std::string& where) {
  EXPECT_TRUE(a.verdict == b.verdict && same_bits(a.t, b.t) && a.steps == b.steps)
      << where << ": " << a.verdict << " at " << a.t << ", not " << b.verdict << " at " << b.t;
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_TRUE(same_bits(a.normal[i], b.normal[i])) << where << ": the normal";
}

// Strategies that ask any() or all() of a packet answer by the company a ray is in: then no answer may contradict
// another.
bool asks_the_packet(const Program& program) {
  for (const auto& callee : program.callees)
    if (asks_the_packet(*callee)) return true;
  for (std::uint32_t i = 0; i < program.graph.size(); ++i)
    if (const Op op = program.graph[Id{i}].op; op == Op::any || op == Op::all) return true;
  return false;
}

class Packets : public testing::TestWithParam<const char*> {
 protected:
  // Casts by every strategy that does not refuse the surface.
  template <class Check>
  void by_every_way(Check check) const {
    for (const test::Way& way : test::ways()) {
      const auto cast = test::caster(model, way);
      if (cast)
        check(*cast, way);
      else
        EXPECT_NE(way.search->name, "stackless") << "it refuses nothing: " << cast.error();
    }
  }

  void expect_agreement(const Caster& cast, const Answer& a, const Answer& b,
                        const std::string& where) const {
    if (!asks_the_packet(cast.program())) return expect_same(a, b, where);
    if (a.verdict == verdict_undecided || b.verdict == verdict_undecided) return;
    EXPECT_EQ(a.verdict, b.verdict) << where;
    if (a.verdict == verdict_hit) { EXPECT_NEAR(a.t, b.t, 1e-4 * rays.front().tmax) << where; }
  }

  const test::SurfaceEntry& entry = test::entry_named(GetParam());
  const Model model = test::model_of(entry);
  const std::vector<Ray> rays = test::rays_of(entry);
};

TEST_P(Packets, of_one_ray_give_what_full_ones_give) {
  by_every_way([&](const Caster& cast, const test::Way& way) {
    const auto together = cast(rays);
    for (std::size_t i = 0; i < rays.size(); ++i)
      expect_agreement(cast, cast(rays[i]), together[i], way.name() + ", ray " + std::to_string(i));
  });
}

// In every lane of packets of up to 16, among rays that have no segment.
TEST_P(Packets, with_one_live_lane_give_what_full_ones_give) {
  by_every_way([&](const Caster& cast, const test::Way& way) {
    const auto together = cast(rays);
    for (std::size_t i = 0; i < std::min<std::size_t>(rays.size(), 32); ++i) {
      Ray none = rays[i];
      std::swap(none.tmin, none.tmax);
      std::vector<Ray> packet(16, none);
      packet[i % 16] = rays[i];
      const auto answers = cast(packet);
      for (std::size_t lane = 0; lane < packet.size(); ++lane) {
        const std::string where =
            way.name() + ", ray " + std::to_string(i) + ", lane " + std::to_string(lane);
        if (lane == i % 16)
          expect_agreement(cast, answers[lane], together[i], where);
        else
          EXPECT_EQ(answers[lane].verdict, verdict_miss) << where;
      }
    }
  });
}

TEST_P(Packets, shuffled_give_the_same) {
  by_every_way([&](const Caster& cast, const test::Way& way) {
    test::Random random(7);
    const auto before = cast(rays);
    std::vector<std::size_t> order(rays.size());
    for (std::size_t i = 0; i < order.size(); ++i) std::swap(order[i] = i, order[random.below(i + 1)]);
    std::vector<Ray> shuffled;
    for (const std::size_t i : order) shuffled.push_back(rays[i]);
    const auto after = cast(shuffled);
    for (std::size_t i = 0; i < order.size(); ++i)
      expect_agreement(cast, after[i], before[order[i]], way.name() + ", ray " + std::to_string(order[i]));
  });
}

TEST_P(Packets, agree_with_the_interpreter) {
  const auto some = std::span(rays).first(20);  // the interpreter is slow
  by_every_way([&](const Caster& cast, const test::Way& way) {
    const auto found = cast(some);
    const auto interpreted = test::caster(model, way, Backend::interpreter);
    ASSERT_TRUE(interpreted) << way.name();
    const auto expected = (*interpreted)(some);
    for (std::size_t i = 0; i < some.size(); ++i)
      expect_agreement(cast, found[i], expected[i], way.name() + ", ray " + std::to_string(i));
  });
}

INSTANTIATE_TEST_SUITE_P(Surfaces, Packets,
                         testing::Values("sphere", "steiner", "tangle", "kummer_16", "torus_sqrt"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace imp
