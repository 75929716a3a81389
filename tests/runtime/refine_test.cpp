// Where a certified root is said to lie: roots that Newton's method misses, or only seems to find.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/cast.h"
#include "tests/support/picture.h"

namespace imp::test {
namespace {

struct StiffRay {
  const char* f;
  Ray ray;
  double t;  // of the first root
};

const StiffRay stiff_rays[] = {
    // Newton's method leaves any bracket of this one.
    {"atan(1000000000*(x - 0.3)) = 0", {{-3, 0, 0}, {1, 0, 0}, 0, 6}, 3.3},
    {"atan(1000000000*(x - 0.3)) = 0", {{-1, 0, 0}, {1, 0, 0}, 0, 2}, 1.3},
    // Two steps shrink as if they converged, on a cliff a twentieth before the root.
    {"(x - 0.648295271396637) + atan(47*(x - 0.5)) + atan(4000000*(x - 0.598295271396637)) = "
     "2.9990856028341026",
     {{0, 0.1, 0.2}, {1, 0, 0}, 0, 1},
     0.648295271396637},
    // f is infinite on both sides.
    {"(x - 0.3)*exp(y + 800) = 0", {{0, 0, 0}, {1, 0, 0}, 0, 1}, 0.3},
    {"x^500 + y^500 + z^500 = 1", {{-3, 0.1, 0.2}, {1, 0, 0}, 0, 6}, 2},
    {"exp(200*x) = 1e20", {{-1, 0, 0}, {1, 0, 0}, 0, 2}, 1 + std::log(1e20) / 200},
};

TEST(Refine, certified_roots_lie_where_they_are_said_to) {
  int hits = 0;
  for (const char* name : {"stackless", "isolate", "segment", "newton"})
    for (const auto& [f, ray, t] : stiff_rays) {
      const Caster cast(model_of(f), {}, {}, {}, *inclusion_named("auto"), *search_named(name));
      const Answer answer = cast(std::vector{ray})[0];
      if (answer.verdict != verdict_hit) continue;
      ++hits;
      EXPECT_NEAR(answer.t, t, certified_length * (ray.tmax - ray.tmin)) << name << ": " << f;
    }
  EXPECT_GE(hits, 12);
}

// The second root lies less than a float behind the place between them that was found.
TEST(Refine, two_roots_that_nearly_touch) {
  const Ray ray{{0.9920680792001177, 0.8031464709853743, -0.43117693859188566},
                {-0.2845901874144085, -0.659121415454014, -0.6958386244293698},
                -0.46709945275208054,
                0.9971034045100494};
  for (const char* name : {"stackless", "isolate", "segment", "newton", "bernstein"}) {
    const Caster cast(model_of("T(18, x) + T(18, y) + T(18, z) = 0"), {}, {}, {}, *inclusion_named("auto"),
                      *search_named(name));
    const Answer answer = cast(std::vector{ray})[0];
    if (std::string_view(name) == "bernstein") { EXPECT_EQ(answer.verdict, verdict_hit); }
    if (answer.verdict != verdict_hit) continue;
    EXPECT_NEAR(answer.t, -2.63612126e-5, certified_length * (ray.tmax - ray.tmin)) << name;
  }
}

// The eye touches one surface; another lies behind it.
TEST(Refine, a_root_that_is_not_decided_hides_what_is_behind_it) {
  const Model model = model_of(
      "surface a: z = 1\nsurface b: z = 0.5 - 0.01*x\ndomain box((-2, -2, -2), (2, 2, 2))\n"
      "camera from (0, 0, 1) to (0.1, 0.05, 0) fov 40\n");
  for (const bool tiles : {true, false})
    for (const Type precision : {f32, f64})
      for (const char* name : {"auto", "isolate", "stackless", "segment", "newton", "bernstein"}) {
        RenderOptions options = sized(9, 9);
        options.tiles = tiles;
        options.kernel.precision = precision;
        options.depth = true;
        options.wish.search = search_named(name);
        const Picture picture = render(model, options);
        for (std::size_t i = 0; i < picture.verdict.size(); ++i)
          if (picture.verdict[i] == verdict_hit) { EXPECT_LT(picture.depth[i], 1e-3) << name; }
      }
}

}  // namespace
}  // namespace imp::test
