// Rays through functions that have no value in places: no hit is where there is none.
#include <gtest/gtest.h>

#include <algorithm>

#include "ir/text.h"
#include "passes/inline.h"
#include "tests/support/ball.h"
#include "tests/support/cast.h"
#include "tests/support/random_domains.h"

namespace imp::test {
namespace {

using State = Ball::State;

// f at a = 1/2, of x, y and z.
Surface without_parameter(const Program& f) {
  Surface surface{"partial", {.name = "partial"}, {}};
  std::vector<Expr> inputs;
  for (const char* name : {"x", "y", "z"})
    inputs.push_back({&surface.f.graph, add_input(surface.f, name, f64, Rate::ray)});
  inputs.push_back(constant_like(inputs[0], 0.5));
  surface.f.outputs = {{"f", inline_program(f, inputs).front().id}};
  return surface;
}

Ball at(const Program& f, const Ray& ray, double t) {
  std::array<double, 3> place;
  for (std::size_t i = 0; i < 3; ++i) place[i] = ray.o[i] + t * ray.d[i];
  return ball_values(f, place)[0];
}

// In steps of which doubles hold each place.
Ray some_ray(Random& random) {
  const auto coordinate = [&] { return static_cast<double>(random.below(17)) / 4 - 2; };
  Ray ray{{-2.125, coordinate(), 0.25}, {1, 0, 0}, 0, 4.25};
  if (random.one_in(2)) ray.d[1] = static_cast<double>(random.below(5)) / 4 - 0.5;
  return ray;
}

class PartialFunctions : public testing::TestWithParam<Type> {};

TEST_P(PartialFunctions, are_hit_and_missed_where_they_have_values) {
  int hits = 0, misses = 0;
  for (std::uint64_t seed = 1; seed <= 250; ++seed) {
    Model model;
    model.surfaces = {without_parameter(random_domains(seed, 1 + static_cast<int>(seed % 3)))};
    const Program& f = model.surfaces[0].f;
    const Caster cast(model, {.backend = Backend::interpreter, .precision = GetParam()});
    Random random(seed);
    for (int i = 0; i < 10; ++i) {
      const Ray ray = some_ray(random);
      const Answer answer = cast(ray);
      const auto where = [&] {
        return fmt::format("{} {}: {}\n{}", seed, to_text(ray), answer.t, to_text(f));
      };
      if (answer.verdict == verdict_hit) {
        const double near = 2e-5 * (ray.tmax - ray.tmin);
        for (const double t : {answer.t - near, answer.t, answer.t + near})
          ASSERT_FALSE(t < ray.tmax && at(f, ray, t).is(State::none)) << where();
        ++hits;
      }
      const double end = answer.verdict == verdict_miss ? ray.tmax : answer.t - 1e-3;
      for (double t = 0; t <= end && answer.verdict != verdict_undecided; t += 0.125) {
        const Ball value = at(f, ray, t);
        ASSERT_FALSE(value.is(State::number) && arb_is_zero(value.get())) << t << " is 0, " << where();
      }
      misses += answer.verdict == verdict_miss;
    }
  }
  EXPECT_GT(hits, 100);
  EXPECT_GT(misses, 500);
}

INSTANTIATE_TEST_SUITE_P(Precisions, PartialFunctions, testing::Values(f32, f64),
                         [](const auto& test) { return test.param == f32 ? "f32" : "f64"; });

}  // namespace
}  // namespace imp::test
