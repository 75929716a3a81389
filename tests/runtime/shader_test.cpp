// Pictures and casts by shaders: what they prove is what machine code proves, or less.
#include <gtest/gtest.h>

#include <cmath>
#include <span>

#include "passes/surface_passes.h"
#include "runtime/method.h"
#include "tests/support/cast.h"
#include "tests/support/effort.h"
#include "tests/support/picture.h"
#include "tests/support/shader.h"

namespace imp {
namespace {

class Shaders : public testing::TestWithParam<const char*> {
 protected:
  const test::SurfaceEntry& entry = test::entry_named(GetParam());
  const Model model = test::model_of(entry);
};

TEST_P(Shaders, show_the_same_picture) {
  IMP_NEEDS_GL();
  for (const Type precision : {f32, f64}) {
    RenderOptions options = test::sized(48, 48);
    options.kernel.precision = precision;
    options.depth = true;
    const Picture expected = test::render(model, options);
    options.kernel.backend = Backend::glsl;
    const Picture shown = test::render(model, options);
    std::size_t drawn_otherwise = 0;
    for (std::size_t i = 0; i < shown.verdict.size(); ++i) {
      EXPECT_FALSE(test::contradict(shown.verdict[i], expected.verdict[i])) << "pixel " << i;
      drawn_otherwise += std::isfinite(shown.depth[i]) != std::isfinite(expected.depth[i]) ? 1 : 0;
    }
    // An enclosure is wider by up to a step of the numbers at each op: in float some that are just proven
    // are drawn, but undecided.
    EXPECT_LE(drawn_otherwise, 2U) << test::verdicts(expected) << test::verdicts(shown);
    if (precision == f64) { EXPECT_EQ(test::verdicts(shown), test::verdicts(expected)); }
    EXPECT_GT(shown.count(verdict_hit), 0U);
  }
}

TEST_P(Shaders, never_contradict_exact_roots) {
  IMP_NEEDS_GL();
  const auto rays = test::rays_of(entry);
  for (const Type precision : {f32, f64}) {
    const auto expected = test::Caster(model, {.precision = precision})(rays);
    const KernelOptions shader{.backend = Backend::glsl, .precision = precision};
    const Method method = choose_method(simplified(model.surfaces[0].f), {}, shader);
    const auto found = test::Caster(model, shader, {}, {}, *method.inclusion, *method.search)(rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      EXPECT_FALSE(test::contradict(found[i].verdict, expected[i].verdict)) << "ray " << i;
      if (found[i].verdict == verdict_hit && expected[i].verdict == verdict_hit) {
        const double length = rays[i].tmax - rays[i].tmin;
        EXPECT_NEAR(found[i].t, expected[i].t, 1e-4 * length) << "ray " << i;
      }
    }
  }
}

constexpr const char* some_entries[] = {"sphere", "steiner", "torus", "tangle", "blobby", "water"};

INSTANTIATE_TEST_SUITE_P(
    Surfaces, Shaders,
    testing::ValuesIn(std::span(some_entries).first(test::effort(std::size(some_entries)))));

}  // namespace
}  // namespace imp
