// Frames of a Renderer: their channels, parameters, sizes and threads.
#include "runtime/render.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "tests/support/picture.h"

namespace imp {
namespace {

using test::model_of;
using test::render;
using test::sized;
using test::verdicts;

constexpr const char* ball_and_camera = "x^2 + y^2 + z^2 = 1\ncamera from (0, 0, 5) to (0, 0, 0) fov 30\n";
constexpr const char* tangle =
    "x^4 - 5*x^2 + y^4 - 5*y^2 + z^4 - 5*z^2 + 11.8 = 0\n"
    "domain box((-2.5, -2.5, -2.5), (2.5, 2.5, 2.5))\n";

using Triple = std::array<double, 3>;

Triple pixel(const std::vector<float>& channel, std::size_t i) {
  return {channel[3 * i], channel[3 * i + 1], channel[3 * i + 2]};
}

bool is(const Triple& color, double red, double green, double blue) {
  return color == Triple{red, green, blue};
}

TEST(Render, depth_normal_and_steps_of_a_ball) {
  const Model model = model_of(ball_and_camera);
  for (const Type precision : {f32, f64}) {
    RenderOptions options = sized(40, 40);
    options.depth = options.normal = options.steps = true;
    options.tiles = false;  // they take steps off rays
    options.kernel.precision = precision;
    const Picture picture = render(model, options);
    const double pixel_size = std::tan(M_PI / 12) / 20;
    int hits = 0;
    for (std::size_t i = 0; i < 1600; ++i) {
      const Triple normal = pixel(picture.normal, i);
      const double length = std::hypot(normal[0], normal[1], normal[2]);
      EXPECT_GE(picture.steps[i], 1);
      EXPECT_LT(picture.steps[i], 500);
      if (picture.verdict[i] == verdict_miss) {
        EXPECT_EQ(picture.depth[i], INFINITY);
        EXPECT_EQ(length, 0);
      }
      if (picture.verdict[i] != verdict_hit) continue;
      ++hits;
      const double u = (static_cast<double>(i % 40) - 19.5) * pixel_size;
      const double v = (19.5 - static_cast<double>(i / 40)) * pixel_size;
      const double c = 1 / std::sqrt(u * u + v * v + 1);  // of the angle at the eye
      const double half = std::sqrt(1 - 25 * (1 - c * c));
      const double depth = 5 * c - half;
      const double tolerance = 1e-5 + 1e-6 / half;  // a ray that grazes it magnifies errors
      EXPECT_NEAR(picture.depth[i], depth, tolerance) << i;
      EXPECT_NEAR(length, 1, 1e-5);
      EXPECT_NEAR(normal[0], depth * u * c, tolerance);
      EXPECT_NEAR(normal[1], depth * v * c, tolerance);
      EXPECT_NEAR(normal[2], 5 - depth * c, tolerance);
    }
    EXPECT_GT(hits, 550);
  }
}

TEST(Render, gives_the_channels_that_were_asked_for) {
  const Picture plain = render(model_of(ball_and_camera), sized(4, 4));
  EXPECT_EQ(plain.color.size(), 48U);
  EXPECT_EQ(plain.verdict.size(), 16U);
  EXPECT_TRUE(plain.depth.empty() && plain.normal.empty() && plain.steps.empty());
}

// Steiner's axes are part of it, but touched only.
TEST(Render, draws_undecided_pixels_as_it_is_told) {
  const Model model = model_of(
      "x^2*y^2 + y^2*z^2 + z^2*x^2 + x*y*z\ndomain box((-1, -1, -1), (1, 1, 1))\n"
      "camera from (0.8, 2, 4) to (0, 0, 0) fov 30");
  RenderOptions options = sized(65, 65);
  options.wish.search = search_named("stackless");  // auto decides in double
  const Picture drawn = render(model, options);
  options.thin = Thin::hide;
  const Picture hidden = render(model, options);
  options.thin = Thin::mark;
  const Picture marked = render(model, options);
  EXPECT_EQ(drawn.verdict, hidden.verdict);
  EXPECT_EQ(drawn.verdict, marked.verdict);
  int undecided = 0, found = 0;
  for (std::size_t i = 0; i < drawn.verdict.size(); ++i) {
    if (drawn.verdict[i] != verdict_undecided) {
      EXPECT_EQ(pixel(drawn.color, i), pixel(hidden.color, i));
      EXPECT_EQ(pixel(drawn.color, i), pixel(marked.color, i));
      EXPECT_EQ(is(pixel(drawn.color, i), 1, 1, 1), drawn.verdict[i] == verdict_miss)
          << "white where nothing is";
      continue;
    }
    ++undecided;
    EXPECT_TRUE(is(pixel(hidden.color, i), 1, 1, 1));
    EXPECT_FALSE(is(pixel(marked.color, i), 1, 1, 1));
    if (!is(pixel(drawn.color, i), 1, 1, 1)) ++found;
  }
  EXPECT_GT(undecided, 0);
  EXPECT_GT(found, 0);
}

TEST(Render, the_nearer_of_two_surfaces) {
  const std::string camera = "camera from (0, 0, 5) to (0, 0, 0) fov 30\n";
  const std::string front = "surface front: x^2 + y^2 + (z - 1)^2 = 0.25\n",
                    back = "surface back: x^2 + y^2 + z^2 = 0.81\n";
  RenderOptions options = sized(32, 32);
  options.depth = true;
  options.tiles = false;  // they cut the ray otherwise for two surfaces, and round t otherwise
  const Picture a = render(model_of(front + camera), options), b = render(model_of(back + camera), options);
  for (const std::string& order : {front + back, back + front}) {
    const Picture both = render(model_of(order + camera), options);
    for (std::size_t i = 0; i < both.verdict.size(); ++i) {
      EXPECT_EQ(both.depth[i], std::min(a.depth[i], b.depth[i]));
      const float nearer = a.depth[i] < b.depth[i] ? a.verdict[i] : b.verdict[i];
      const bool may_doubt = a.verdict[i] != b.verdict[i];
      EXPECT_TRUE(both.verdict[i] == nearer || (may_doubt && both.verdict[i] == verdict_undecided));
    }
  }
  const Model model = model_of(front + back + camera);
  options.surfaces = {1};
  EXPECT_EQ(render(model, options).depth, b.depth) << "one of them alone";
}

// Where the search for one surface gives up, what it has not seen may hide the other one.
TEST(Render, no_hit_behind_what_was_not_searched) {
  const std::string camera = "camera from (0, 0, 5) to (0, 0, 0) height 1\n";
  const std::string easy = "surface easy: z = 0\n";
  const std::string hard =
      "surface hard: (x - x + z - 1)^2 - (z - 1)^2 + 1e-9 + (z - 1.9)^4 = 0\n";  // wide, no root
  RenderOptions options = sized(4, 4);
  EXPECT_EQ(verdicts(render(model_of(easy + camera), options)), "\n####\n####\n####\n####\n");
  options.limits.steps = 80;
  EXPECT_EQ(verdicts(render(model_of(easy + camera), options)), "\n####\n####\n####\n####\n");
  EXPECT_EQ(verdicts(render(model_of(hard + camera), options)), "\n????\n????\n????\n????\n");
  EXPECT_EQ(verdicts(render(model_of(easy + hard + camera), options)), "\n????\n????\n????\n????\n");
  EXPECT_EQ(verdicts(render(model_of(hard + easy + camera), options)), "\n????\n????\n????\n????\n");
}

TEST(Render, parameters_change_without_a_new_kernel) {
  const Model model = model_of(
      "param r = 1 in [0, 2]\ntime w = 0\nx^2 + y^2 + (z - w)^2 = r^2\n"
      "domain sphere(radius: 2*r + w)\ncamera from (0, 0, 5 + w) to (0, 0, w) fov 30\n");
  Diagnostics diagnostics;
  RenderOptions options = sized(24, 24);
  options.depth = true;
  const auto renderer = Renderer::make(model, options, diagnostics);
  ASSERT_TRUE(renderer) << to_text(diagnostics);
  const Picture one = renderer->frame({1, 0}), small = renderer->frame({0.5, 0}),
                later = renderer->frame({1, 1});
  EXPECT_EQ(verdicts(one), verdicts(render(model_of(ball_and_camera), options)));
  EXPECT_LT(small.count(verdict_hit), one.count(verdict_hit) / 3);
  EXPECT_GT(small.count(verdict_hit), one.count(verdict_hit) / 6);
  EXPECT_EQ(verdicts(later), verdicts(one)) << "the camera follows";
  EXPECT_EQ(verdicts(renderer->frame({1, 0})), verdicts(one));
  EXPECT_EQ(verdicts(render(model, options, {{"r", 0.5}})), verdicts(small));
  EXPECT_EQ(verdicts(render(model, options, {}, 1)), verdicts(later));
}

// The names of what the kernel adds are not taken from the file.
TEST(Render, parameters_may_be_called_anything) {
  const std::string expected = verdicts(render(model_of(ball_and_camera), sized(16, 16)));
  for (const std::string name : {"x0", "y0", "row", "column", "slab", "eye", "s", "verdict"})
    EXPECT_EQ(verdicts(render(model_of("param " + name + " = 1\nx^2 + y^2 + z^2 = " + name +
                                       "\ncamera from (0, 0, 5) to (0, 0, 0) fov 30"),
                              sized(16, 16))),
              expected)
        << name;
}

bool same(const Picture& a, const Picture& b) {
  return a.color == b.color && a.verdict == b.verdict && a.depth == b.depth && a.normal == b.normal &&
         a.steps == b.steps;
}

TEST(Render, the_same_by_any_number_of_threads) {
  RenderOptions options = sized(200, 130);
  options.depth = options.normal = options.steps = true;
  const Model model = model_of(tangle);
  const Picture one = render(model, options);
  for (const unsigned threads : {2u, 3u, 0u}) {
    options.workers = std::make_shared<Workers>(threads);
    EXPECT_TRUE(same(one, render(model, options))) << threads;
  }
}

TEST(Render, the_same_verdicts_by_the_interpreter) {
  for (const std::string source : {ball_and_camera, tangle}) {
    RenderOptions options = sized(16, 16);
    options.depth = options.steps = true;
    const Picture compiled = render(model_of(source), options);
    options.kernel.backend = Backend::interpreter;
    const Picture interpreted = render(model_of(source), options);
    EXPECT_EQ(verdicts(compiled), verdicts(interpreted));
    EXPECT_EQ(compiled.depth, interpreted.depth);
    EXPECT_EQ(compiled.steps, interpreted.steps);
  }
}

// A pixel is the same in a picture of any size that shows it at the same place, but for roundings of
// the camera.
TEST(Render, sizes_that_are_no_tiles) {
  const auto show = [](std::size_t width, std::size_t height) {
    const double lengths = 0.0503 * static_cast<double>(height);  // no pixel's ray is tangent to the ball
    return render(
        model_of("x^2 + y^2 + z^2 = 1\ncamera from (0, 0, 5) to (0, 0, 0) height " + std::to_string(lengths)),
        sized(width, height));
  };
  const Picture large = show(129, 65);
  for (const auto& [width, height] : {std::pair{1, 1}, {65, 3}, {3, 65}, {63, 1}, {127, 63}}) {
    const Picture small = show(static_cast<std::size_t>(width), static_cast<std::size_t>(height));
    ASSERT_EQ(small.verdict.size(), static_cast<std::size_t>(width * height));
    for (int j = 0; j < height; ++j)
      for (int i = 0; i < width; ++i) {
        const float expected =
            large.verdict[static_cast<std::size_t>((j + (65 - height) / 2) * 129 + i + (129 - width) / 2)];
        const float verdict = small.verdict[static_cast<std::size_t>(j * width + i)];
        EXPECT_TRUE(verdict == expected || verdict < 0 || expected < 0)
            << width << " x " << height << ": " << i << ", " << j;
      }
  }
}

TEST(Render, stops_when_asked) {
  Diagnostics diagnostics;
  const Model model = model_of(ball_and_camera);
  const auto renderer = Renderer::make(model, sized(256, 256), diagnostics).value();
  std::stop_source stop;
  const Picture some = renderer.frame({}, stop.get_token(), [&](double) { stop.request_stop(); });
  EXPECT_EQ(some.count(verdict_undecided), 256U * 256 - 64 * 64) << "what was not made is not known";
  const Picture none = renderer.frame({}, stop.get_token());
  EXPECT_EQ(none.count(verdict_undecided), 256U * 256);
}

TEST(Render, refuses_what_no_target_is) {
  Diagnostics diagnostics;
  RenderOptions options = sized(4, 4);
  options.kernel.target = "avx1024";
  const Model model = model_of(ball_and_camera);
  EXPECT_FALSE(Renderer::make(model, options, diagnostics));
  EXPECT_TRUE(to_text(diagnostics).contains("unknown target 'avx1024'; there are: host"))
      << to_text(diagnostics);
}

TEST(Render, a_camera_without_a_direction_sees_nothing) {
  const Picture picture =
      render(model_of("x^2 + y^2 + z^2 = 1\ncamera from (0, 0, 5) to (0, 0, 5) fov 30"), sized(8, 8));
  EXPECT_EQ(picture.count(verdict_hit), 0U);
}

}  // namespace
}  // namespace imp
