// Pictures of scenes that are hard to draw, by every strategy: each certified pixel is right for its ray, to within
// what rounding in float moves the ray.
#include <gtest/gtest.h>

#include "tests/support/picture.h"
#include "tests/support/pixel_answers.h"
#include "tests/support/real_roots.h"
#include "tests/support/ways.h"

namespace imp {
namespace {

using test::Answer;
using test::Ray;

struct Scene {
  const char* name;
  const char* source;   // with a camera
  double hits, misses;  // the share of pixels that `auto` certifies in double, at least
  const char* zeros{};  // a polynomial with the same zeros; null: the surface is one
};

void PrintTo(const Scene& scene, std::ostream* out) { *out << scene.name; }

constexpr std::size_t side = test::sanitized ? 12 : 24;

RenderOptions options_of(const test::Way& way) {
  RenderOptions options = test::sized(side, side);
  options.wish = {way.search, way.inclusion};
  options.kernel.precision = way.precision;
  return options;
}

// Of all rays beside the pixel's, what is wrong with each.
std::string mistake(const Program& f, const test::PixelAnswer& pixel) {
  if (pixel.answer.verdict == verdict_undecided) return "";
  if (!(pixel.ray.tmin < pixel.ray.tmax))
    return pixel.answer.verdict == verdict_hit ? "a hit outside the domain" : "";
  const double slack = std::ldexp(pixel.answer.t, -22);  // depths are floats
  std::string all;
  for (const Ray& ray : test::rays_beside(pixel.ray)) {
    const std::string wrong =
        test::exact_mistake(f, ray, pixel.answer, pixel.answer.verdict == verdict_hit ? slack : 0);
    if (wrong.empty()) return "";
    all = all.empty() ? test::to_text(ray) + ": " + wrong : all + "; " + wrong;
  }
  return all;
}

class HardPictures : public testing::TestWithParam<Scene> {};

TEST_P(HardPictures, are_right_where_they_are_certified) {
  const Scene& scene = GetParam();
  const Model model = test::model_of(scene.source);
  const Model zeros = scene.zeros ? test::model_of(scene.zeros) : model;
  for (const test::Way& way : test::ways()) {
    const auto pixels = test::pixel_answers(model, options_of(way));
    if (!pixels) {
      EXPECT_NE(way.search->name, "stackless") << "it refuses nothing: " << pixels.error();
      continue;
    }
    double hits = 0, misses = 0;
    for (const test::PixelAnswer& pixel : *pixels) {
      hits += pixel.answer.verdict == verdict_hit ? 1 : 0;
      misses += pixel.answer.verdict == verdict_miss ? 1 : 0;
      EXPECT_EQ(mistake(zeros.surfaces[0].f, pixel), "") << way.name();
    }
    if (!test::is_of_auto(way) || way.precision != f64) continue;
    EXPECT_GE(hits, scene.hits * side * side) << way.name();
    EXPECT_GE(misses, scene.misses * side * side) << way.name();
  }
}

const Scene scenes[] = {
    {"from_inside", "x^2 + y^2 + z^2 = 1\ncamera from (0.25, 0, 0.5) to (0, 0, 0) fov 90", 0.9, 0},
    {"from_the_surface_inward", "x^2 + y^2 + z^2 = 1\ncamera from (0, 0, 1) to (0, 0, 0) fov 60", 0, 0},
    {"from_the_surface_outward", "x^2 + y^2 + z^2 = 1\ncamera from (0, 0, 1) to (0, 0, 2) fov 60", 0, 0},
    {"from_the_surface_along", "x^2 + y^2 + z^2 = 1\ncamera from (0, 1, 0) to (1, 1, 0) up (0, 1, 0) fov 60",
     0, 0},
    {"faces_cut_a_ball",
     "x^2 + y^2 + z^2 = 1\ndomain box((-0.75, -0.75, -0.75), (0.75, 0.75, 0.75))\n"
     "camera from (3, 2, 4) to (0, 0, 0) fov 24",
     0.2, 0.2},
    {"a_face_in_the_surface",
     "x*(x^2 + y^2 + z^2 - 1)\ndomain box((0, -2, -2), (2, 2, 2))\ncamera from (-4, 1, 1) to (0, 0, "
     "0) fov 30",
     0, 0},
    {"a_ball_in_a_ball_of_its_size",
     "x^2 + y^2 + z^2 = 1\ndomain sphere(radius: 1)\ncamera from (0, 0, 4) to (0, 0, 0) fov 40", 0, 0.3},
    {"kissing_balls",
     "((x-1)^2 + y^2 + z^2 - 1)*((x+1)^2 + y^2 + z^2 - 1)\ncamera from (0, 0, 6) to (0, 0, 0) fov 4", 0.2, 0},
    {"umbrella_from_above", "x^2 - y^2*z\ncamera from (0, 0.125, 4) to (0, 0, 0) up (0, 1, 0) fov 30", 0.2,
     0},
    {"steiner", "x^2*y^2 + y^2*z^2 + z^2*x^2 + x*y*z\ncamera from (0, 0, 4) to (0, 0, 0) height 1.5", 0.2,
     0.2},
    {"a_pole", "1/x + y + z\ncamera from (2, 3, 4) to (0, 0, 0) fov 30", 0.15, 0.2, "1 + x*(y + z)"},
    {"a_pole_close_up",
     "1/x + y + z\ndomain box((-1, -1, -1), (1, 1, 1))\ncamera from (-1, 0, 0) to (0, 0, 0) fov 30", 0, 0.2,
     "1 + x*(y + z)"},
    {"a_ball_from_far_away", "x^2 + y^2 + z^2 = 1\ncamera from (3000, 2000, 4000) to (0, 0, 0) fov 0.03", 0.2,
     0.2},
    {"beyond_float",
     "1e30*x^5*y^4 + 1e30*z = 1e29\ndomain box((-100, -100, -100), (100, 100, 100))\n"
     "camera from (200, 300, 400) to (0, 0, 0) fov 30",
     0.1, 0, "10*x^5*y^4 + 10*z - 1"},
    {"planes_that_meet", "x*y*z\ncamera from (3, 2, 4) to (0, 0, 0) fov 20", 0.5, 0},
};

INSTANTIATE_TEST_SUITE_P(Scenes, HardPictures, testing::ValuesIn(scenes),
                         [](const testing::TestParamInfo<Scene>& test) {
                           return std::string(test.param.name);
                         });

// x^500 + y^500 + z^500 = 1: from the front it is a square with round corners.
TEST(HardPictures, of_a_cube_with_the_least_of_round_corners) {
  const Model model =
      test::model_of("x^500 + y^500 + z^500 = 1\ncamera from (0, 0, 4) to (0, 0, 0) height 2.5");
  for (const test::Way& way : test::ways()) {
    const auto pixels = test::pixel_answers(model, options_of(way));
    if (!pixels) continue;
    std::size_t decided = 0;
    for (const test::PixelAnswer& pixel : *pixels) {
      if (pixel.answer.verdict == verdict_undecided) continue;
      ++decided;
      const double most = std::max(std::abs(pixel.ray.o[0]), std::abs(pixel.ray.o[1]));
      const double rest = 1 - std::pow(pixel.ray.o[0], 500) - std::pow(pixel.ray.o[1], 500);
      if (most < 0.99) {
        EXPECT_EQ(pixel.answer.verdict, verdict_hit) << way.name();
        EXPECT_NEAR(pixel.answer.t, pixel.ray.o[2] - std::pow(rest, 1.0 / 500), 1e-4) << way.name();
      } else if (most > 1.01) {
        EXPECT_EQ(pixel.answer.verdict, verdict_miss) << way.name();
      }
    }
    if (way.search->name == "stackless") { EXPECT_GT(decided, 0.9 * side * side) << way.name(); }
  }
}

// Steiner's axes are touched, not crossed: undecided, and drawn by policy.
TEST(HardPictures, draw_thin_parts_as_they_are_told) {
  const Model model = test::model_of(
      "x^2*y^2 + y^2*z^2 + z^2*x^2 + x*y*z\ndomain box((-1, -1, -1), (1, 1, 1))\n"
      "camera from (0.8, 2, 4) to (0, 0, 0) fov 30");
  for (const test::Way& way : test::ways()) {
    if (!test::is_of_auto(way)) continue;
    RenderOptions options = options_of(way);
    options.width = options.height = 65;  // the axis through the middle lies on pixels
    Diagnostics diagnostics;
    if (!pixel_program(model, options, diagnostics)) continue;
    std::vector<Picture> pictures;
    for (const Thin thin : {Thin::draw, Thin::hide, Thin::mark}) {
      options.thin = thin;
      pictures.push_back(test::render(model, options));
      EXPECT_EQ(pictures.back().verdict, pictures.front().verdict) << way.name();
    }
    EXPECT_GT(pictures[0].count(verdict_undecided), 0U) << way.name();
    for (std::size_t i = 0; i < pictures[0].verdict.size(); ++i) {
      const auto is = [&](const Picture& p, std::array<float, 3> color) {
        return std::equal(color.begin(), color.end(), p.color.begin() + static_cast<std::ptrdiff_t>(3 * i));
      };
      const bool undecided = pictures[0].verdict[i] == verdict_undecided;
      const bool missed = pictures[0].verdict[i] == verdict_miss;
      EXPECT_EQ(is(pictures[1], {1, 1, 1}), undecided || missed) << way.name() << ", pixel " << i;
      EXPECT_EQ(is(pictures[2], {1, 0, 0.8F}), undecided) << way.name() << ", pixel " << i;
    }
  }
}

}  // namespace
}  // namespace imp
