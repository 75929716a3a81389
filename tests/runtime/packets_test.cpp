// A ray's answer is its own: what else is in its packet, in which order, and which backend casts it
// change nothing.
#include <gtest/gtest.h>

#include "tests/support/cast.h"
#include "tests/support/evaluate.h"
#include "tests/support/random.h"

namespace imp {
namespace {

using test::Answer;
using test::Caster;
using test::Ray;
using test::same_bits;

constexpr const char* some_entries[] = {"sphere",    "steiner",        "tangle",
                                        "kummer_16", "random_quintic", "torus_sqrt"};

void expect_same(const Answer& a, const Answer& b, const std::string& where) {
  EXPECT_TRUE(a.verdict == b.verdict && same_bits(a.t, b.t) && a.steps == b.steps)
      << where << ": " << a.verdict << " at " << a.t << ", not " << b.verdict << " at " << b.t;
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_TRUE(same_bits(a.normal[i], b.normal[i])) << where << ": the normal";
}

class Packets : public testing::TestWithParam<const char*> {
 protected:
  const test::SurfaceEntry& entry = test::entry_named(GetParam());
  const Model model = test::model_of(entry);
  const std::vector<Ray> rays = test::rays_of(entry);
};

TEST_P(Packets, of_one_ray_give_what_full_ones_give) {
  const Caster cast(model);
  const auto together = cast(rays);
  for (std::size_t i = 0; i < rays.size(); ++i)
    expect_same(cast(rays[i]), together[i], "ray " + std::to_string(i));
}

TEST_P(Packets, shuffled_give_the_same) {
  test::Random random(7);
  for (const Type precision : {f32, f64}) {
    const Caster cast(model, {.precision = precision});
    const auto before = cast(rays);
    std::vector<std::size_t> order(rays.size());
    for (std::size_t i = 0; i < order.size(); ++i) std::swap(order[i] = i, order[random.below(i + 1)]);
    std::vector<Ray> shuffled;
    for (const std::size_t i : order) shuffled.push_back(rays[i]);
    const auto after = cast(shuffled);
    for (std::size_t i = 0; i < order.size(); ++i)
      expect_same(after[i], before[order[i]], "ray " + std::to_string(order[i]));
  }
}

TEST_P(Packets, agree_with_the_interpreter) {
  const auto some = std::span(rays).first(20);  // the interpreter is slow
  for (const Type precision : {f32, f64}) {
    const auto expected = Caster(model, {.backend = Backend::interpreter, .precision = precision})(some);
    const auto found = Caster(model, {.precision = precision})(some);
    for (std::size_t i = 0; i < some.size(); ++i)
      expect_same(found[i], expected[i], to_text(precision) + ", ray " + std::to_string(i));
  }
}

INSTANTIATE_TEST_SUITE_P(Surfaces, Packets, testing::ValuesIn(some_entries),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace imp
