// Beams: a picture that tiles were searched for together is the picture of its rays.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/effort.h"
#include "tests/support/picture.h"

namespace imp {
namespace {

// By `search` behind beams and without them. 70 and 50 are no multiples of a cell.
std::size_t compare(const Model& model, const char* search, std::size_t more_undecided = 2) {
  RenderOptions options = test::sized(70, 50);
  options.depth = true;
  options.wish.search = search ? search_named(search) : nullptr;
  const Picture tiled = test::render(model, options);
  options.tiles = false;
  const Picture rays = test::render(model, options);
  for (std::size_t i = 0; i < rays.verdict.size(); ++i) {
    EXPECT_FALSE(test::contradict(tiled.verdict[i], rays.verdict[i])) << "pixel " << i;
    if (tiled.verdict[i] == verdict_hit && rays.verdict[i] == verdict_hit) {
      EXPECT_NEAR(tiled.depth[i], rays.depth[i], 1e-3F) << "pixel " << i;
    }
  }
  EXPECT_LE(tiled.count(verdict_undecided), rays.count(verdict_undecided) + more_undecided)
      << test::verdicts(tiled) << test::verdicts(rays);
  return tiled.count(verdict_hit);
}

TEST(Beams, show_the_picture_of_the_rays) {
  for (const char* id : {"sphere", "torus", "steiner", "tangle", "klein_bottle", "blobby"}) {
    SCOPED_TRACE(id);
    EXPECT_GT(compare(test::model_of(test::entry_named(id)), nullptr), 0U);
  }
}

// Where a cell of 8 x 8 pixels is small beside the surface, most rays have nothing left to search.
TEST(Beams, take_steps_off_rays) {
  const auto mean_steps = [](bool tiles) {
    RenderOptions options = test::sized(256, 256);
    options.steps = true;
    options.tiles = tiles;
    const Picture picture = test::render(test::model_of(test::entry_named("sphere")), options);
    double sum = 0;
    for (const float steps : picture.steps) sum += steps;
    return sum / static_cast<double>(picture.steps.size());
  };
  EXPECT_LT(mean_steps(true), 0.5 * mean_steps(false));
}

// Where slabs lie out of a flat domain, and where a domain ends before it is known on which side of the surface.
TEST(Beams, take_nearly_all_steps_off_a_sheet) {
  RenderOptions options = test::sized(256, 256);
  options.steps = true;
  for (const char* domain : {"box((-20, -1, -20), (20, 1, 20))", "box((-20, -0.05, -20), (20, 0.05, 20))"}) {
    const Picture picture = test::render(
        test::model_of(
            std::string("y = 0.1*sin(x)*cos(z)\ncamera from (16, 22, 50) to (0, -2, 0) fov 52\ndomain ") +
            domain),
        options);
    double steps = 0;
    for (const float each : picture.steps) steps += each;
    EXPECT_LT(steps, 0.6 * static_cast<double>(picture.count(verdict_hit))) << domain;
    EXPECT_GT(picture.count(verdict_hit), 5000U);
    EXPECT_EQ(picture.count(verdict_undecided), 0U);
  }
}

// Cubics with a domain that cuts them, seen from anywhere, from within too.
TEST(Beams, of_random_scenes) {
  std::mt19937 random(1);
  const auto number = [&](double lo, double hi) {
    return fmt::format("{:.4f}", std::uniform_real_distribution(lo, hi)(random));
  };
  const auto place = [&](double size) {
    return fmt::format("({}, {}, {})", number(-size, size), number(-size, size), number(-size, size));
  };
  std::size_t hits = 0;
  for (std::size_t i = 0; i < test::effort(24); ++i) {
    std::string text = number(-1, 1);
    for (const char* term :
         {"x", "y", "z", "x^2", "x*y", "y^2", "y*z", "z^2", "z*x", "x^3", "x*y*z", "y^3", "z^2*x"})
      text += fmt::format(" + {}*{}", number(-1, 1), term);
    text += fmt::format(" = 0\ndomain box((-1, {}, -1.2), (1, {}, {}))", number(-1, 0), number(0.1, 1),
                        number(-1, 1));
    text +=
        fmt::format("\ncamera from {} to {} fov {}", place(i % 4 == 0 ? 1 : 5), place(0.3), number(10, 90));
    SCOPED_TRACE(text);
    hits += compare(test::model_of(text), nullptr);
  }
  EXPECT_GT(hits, 200 * test::effort(24));
}

// Where floats round a place by more than the distance of neighbouring roots from the end of a run: far away, and far from
// the origin. The line of a ray may be a rounding off, so silhouettes differ, but no root in front of another is lost.
TEST(Beams, lose_no_root_to_rounding) {
  for (const char* text :
       {"x^2 + y^2 + z^2 = 0.8\ndomain box((-1, -1, -1), (1, 1, 1))\n"
        "camera from (300, 200, 1000) to (0, 0, 0) fov 0.11",
        "x^2 + y^2 + z^2 = 0.8\ndomain box((-1, -1, -1), (1, 1, 1))\n"
        "camera from (3000, 2000, 10000) to (0, 0, 0) fov 0.011",
        "(x - 1000)^2 + (y - 1000)^2 + (z - 1000)^2 = 1\ndomain box((999, 999, 1000), (1001, 1001, 1001))\n"
        "camera from (1000.9, 1000.6, 1003) to (1000, 1000, 1000.5) fov 50"}) {
    SCOPED_TRACE(text);
    const Model model = test::model_of(text);
    RenderOptions options = test::sized(512, 512);
    options.depth = true;
    const Picture tiled = test::render(model, options);
    options.tiles = false;
    const Picture rays = test::render(model, options);
    int contradictions = 0, elsewhere = 0;
    for (std::size_t i = 0; i < rays.verdict.size(); ++i) {
      const bool both = tiled.verdict[i] == verdict_hit && rays.verdict[i] == verdict_hit;
      elsewhere += both && std::abs(tiled.depth[i] - rays.depth[i]) > 0.04F ? 1 : 0;
      contradictions += test::contradict(tiled.verdict[i], rays.verdict[i]) ? 1 : 0;
    }
    EXPECT_EQ(elsewhere, 0);
    EXPECT_LE(contradictions, 40);  // of 1600 pixels on the silhouette
  }
}

// Without a second look. Bisection leaves grazing rays undecided, and other ends of the segments other ones: more here, a
// quarter of them at 512 x 512.
TEST(Beams, stand_before_any_strategy) {
  for (const Search& search : searches()) {
    SCOPED_TRACE(search.name);
    EXPECT_GT(compare(test::model_of(test::entry_named("torus")), search.name.data(),
                      search.name == "stackless" ? 7 : 2),
              0U);
  }
}

TEST(Beams, for_every_camera_and_domain) {
  const char* const surface = "x^2 + y^2 - z^2 = 0.2\n";
  for (const char* view : {
           "domain sphere(radius: 1.5)\ncamera from (3, 2, 4) to (0, 0, 0) fov 30",
           "domain box((-1, -1, -1), (1, 1, 1))\ncamera from (3, 2, 4) to (0, 0, 0) height 4",
           "domain box((-1, -1, -1), (1, 1, 1))\ncamera from (0, 0, 0.1) to (1, 0.2, 0) fov 100",  // within
           "domain box((-1, -1, -1), (1, 1, 1))\ncamera from (0.5, 0, 0) to (0, 1, 1) fov 60",
           "domain box((-1, -1, 0.3), (1, 1, 0.4))\ncamera from (3, 2, 4) to (0, 0, 0) fov 20",  // cuts it
       }) {
    SCOPED_TRACE(view);
    EXPECT_GT(compare(test::model_of(std::string(surface) + view), nullptr), 0U);
  }
}

// Where a pole lies between two signs there is no surface.
TEST(Beams, do_not_show_poles) {
  RenderOptions options = test::sized(40, 40);
  const Picture picture =
      test::render(test::model_of("1/x = 0\ndomain box((-1, -1, -1), (1, 1, 1))"), options);
  EXPECT_EQ(picture.count(verdict_hit), 0U) << test::verdicts(picture);
}

// What is nowhere defined, and what fills the domain.
TEST(Beams, miss_what_has_no_values) {
  RenderOptions options = test::sized(40, 40);
  for (const char* source : {"sqrt(-1 - x^2) + y", "x^2 + 1", "log(x - 3) + y"}) {
    const Picture picture = test::render(test::model_of(source), options);
    EXPECT_EQ(picture.count(verdict_miss), 1600U) << source << test::verdicts(picture);
  }
}

TEST(Beams, of_several_surfaces) {
  EXPECT_GT(
      compare(test::model_of(
                  "surface ball: x^2 + y^2 + z^2 = 1\nsurface plane: x + y = 0.3\ndomain sphere(radius: 2)"),
              nullptr),
      0U);
}

}  // namespace
}  // namespace imp
