// Scenes that are hard to search, with rays where they are hardest, by every strategy: a certified answer is never
// wrong. The truth is exact where the surface is a polynomial, or has the zeros of one; else it is what dense
// samples and ball arithmetic say.
#include <gtest/gtest.h>

#include <map>

#include "tests/runtime/hard_surfaces.h"
#include "tests/support/aimed_rays.h"
#include "tests/support/judge.h"
#include "tests/support/real_roots.h"
#include "tests/support/ways.h"

namespace imp {
namespace {

using test::Answer;
using test::ball;
using test::double_pole;
using test::kissing_balls;
using test::pole;
using test::Ray;
using test::shell;
using test::steiner;
using test::teardrop;
using test::umbrella;

// A scene, and where rays are hardest.
struct HardPlace {
  const char* name;
  const char* source;
  std::array<double, 3> place;
  double scale;
  double decided;  // the share of rays that `auto` decides in double, at least: the test tests something
  const char*
      zeros{};  // a polynomial with the same zeros, or what is easier to sample; null: the surface itself
};

void PrintTo(const HardPlace& scene, std::ostream* out) { *out << scene.name; }
std::string place_name(const testing::TestParamInfo<HardPlace>& test) { return test.param.name; }

constexpr std::size_t rays_a_scene = test::effort(200);

template <class Mistake>
void expect_no_mistake(const HardPlace& scene, const std::vector<Ray>& rays, Mistake mistake) {
  const Model model = test::model_of(scene.source);
  for (const test::Way& way : test::ways({"auto", "ia"})) {
    const auto cast = test::caster(model, way);
    if (!cast) {
      EXPECT_NE(way.search->name, "stackless") << "it refuses nothing: " << cast.error();
      continue;
    }
    const auto answers = (*cast)(rays);
    std::size_t decided = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      decided += answers[i].verdict == verdict_undecided ? 0 : 1;
      EXPECT_EQ(mistake(rays[i], answers[i]), "") << way.name() << ": " << test::to_text(rays[i]);
    }
    if (test::is_of_auto(way) && way.precision == f64) {
      EXPECT_GE(static_cast<double>(decided), scene.decided * static_cast<double>(rays.size())) << way.name();
    }
  }
  const auto few = std::span(rays).first(10);
  for (const test::Way& way : test::ways()) {
    const auto cast = test::caster(model, way, Backend::interpreter);
    if (!cast) continue;
    const auto answers = (*cast)(few);
    for (std::size_t i = 0; i < few.size(); ++i)
      EXPECT_EQ(mistake(few[i], answers[i]), "") << way.name() << ", interpreter: " << test::to_text(few[i]);
  }
}

constexpr const char* cayley = "2*(x*y + y*z + z*x) = 5*(x^2*(y + z) + y^2*(z + x) + z^2*(x + y))";
constexpr const char*
    clebsch =  // three times as large as usual, so that its rational lines are of whole numbers
    "3*(x^3 + y^3 + z^3) - 7*(x^2*(y + z) + y^2*(z + x) + z^2*(x + y)) + 2*x*y*z + 14*(x*y + y*z + z*x) "
    "- (x^2 + y^2 + z^2) - 3*(x + y + z) + 1";
constexpr const char* nearly_barth =  // tau is a double, so the nodes are a little open or closed
    "4*(t^2*x^2 - y^2)*(t^2*y^2 - z^2)*(t^2*z^2 - x^2) - (1 + 2*t)*(x^2 + y^2 + z^2 - 1)^2\nt = "
    "13254217/8191557";

class Polynomials : public testing::TestWithParam<HardPlace> {};

TEST_P(Polynomials, are_answered_right) {
  const HardPlace& scene = GetParam();
  const Model zeros = test::model_of(scene.zeros ? scene.zeros : scene.source);
  expect_no_mistake(scene, test::rays_at(scene.place, scene.scale, rays_a_scene, 3),
                    [&](const Ray& ray, const Answer& answer) {
                      return test::exact_mistake(zeros.surfaces[0].f, ray, answer);
                    });
}

const HardPlace polynomials[] = {
    {"kissing_balls", kissing_balls, {0, 0, 0}, 1, 0.5},
    {"kissing_balls_close_up", kissing_balls, {0, 0, 0}, 1e-3, 0.4},
    {"balls_a_millionth_apart",
     "((x-1)^2 + y^2 + z^2 - 1)*((x+1+1/2^20)^2 + y^2 + z^2 - 1)",
     {0, 0, 0},
     1e-3,
     0.5},
    {"thin_shell", shell, {0.6, 0.8, 0}, 1, 0.5},
    {"thin_shell_close_up", shell, {0.6, 0.8, 0}, 1e-3, 0.5},
    {"ball_close_up", ball, {0.6, 0.8, 0}, 1e-4, 0.5},
    {"umbrella_handle", umbrella, {0, 0, -1}, 1, 0.5},
    {"umbrella_pinch", umbrella, {0, 0, 0}, 1e-3, 0.5},
    {"steiner_axis", steiner, {0, 0, 0.25}, 0.5, 0.5},
    {"steiner_middle", steiner, {0, 0, 0}, 1e-3, 0.5},
    {"teardrop_whisker", teardrop, {0, 0, 0}, 0.5, 0.5},
    {"teardrop_tip", teardrop, {0, 0, 0}, 1e-2, 0.5},
    {"cayley_node", cayley, {0, 0, 0}, 1e-3, 0.5},
    {"clebsch", clebsch, {0, 0.5, 0.5}, 1, 0.5},
    {"barth_node", nearly_barth, {1, 1, 1}, 1e-3, 0.5},
    {"pole", pole, {0, 0, 0}, 1, 0.5, "1 + x*(y + z)"},
    {"pole_close_up", pole, {0, 0, 0}, 1e-3, 0.5, "1 + x*(y + z)"},
    {"double_pole", double_pole, {0, -1, 0}, 1, 0.1, "1 + x^2*y"},
    {"beyond_float", "1e30*x^5*y^4 + 1e30*z = 1e29", {0, 0, 0}, 1e2, 0.1, "10*x^5*y^4 + 10*z - 1"},
    {"below_float", "1e-30*(x^2*y^2 + z^4) = 1e-31", {0, 0, 0}, 1, 0.5, "10*(x^2*y^2 + z^4) - 1"},
    {"triple_plane", "(x + y/3)^3", {0, 0, 0}, 1, 0.5},
    {"double_ball", "(x^2 + y^2 + z^2 - 1)^2", {0.6, 0.8, 0}, 1, 0.01},
    {"a_product_of_planes", "x*(x - 1e-5)*y*(y + 1e-5)*z", {0, 0, 0}, 1, 0.3},
};

INSTANTIATE_TEST_SUITE_P(Scenes, Polynomials, testing::ValuesIn(polynomials), place_name);

class Samples : public testing::TestWithParam<HardPlace> {};

TEST_P(Samples, are_answered_right) {
  const HardPlace& scene = GetParam();
  const test::Judge judge(test::model_of(scene.zeros ? scene.zeros : scene.source));
  expect_no_mistake(scene, test::rays_at(scene.place, scene.scale, rays_a_scene, 4),
                    [&](const Ray& ray, const Answer& answer) {
                      const bool wrong = judge(ray, judge.roots(ray), answer) == test::Judgement::wrong;
                      return wrong ? fmt::format("{} at {}", answer.verdict, answer.t) : "";
                    });
}

const HardPlace others[] = {
    {"tan", "tan(x) + y", {M_PI / 2, 0, 0}, 1, 0.5, "sin(x) + y*cos(x)"},
    {"tan_close_up", "tan(x) + y", {M_PI / 2, 0, 0}, 1e-3, 0.5, "sin(x) + y*cos(x)"},
    {"reciprocal_of_a_sine", "1/sin(x) + y", {0, 0, 0}, 1, 0.5, "1 + y*sin(x)"},
    {"barth_node",
     "tau = (1 + sqrt(5))/2\n"
     "4*(tau^2*x^2 - y^2)*(tau^2*y^2 - z^2)*(tau^2*z^2 - x^2) = (1 + 2*tau)*(x^2 + y^2 + z^2 - 1)^2",
     {1, 1, 1},
     1e-3,
     0.5},
    {"edge_of_a_root", "sqrt(x) + y", {0, 0, 0}, 1, 0.1},
    {"edge_of_a_logarithm", "log(x) + y", {0, 2, 0}, 1, 0.1},
    {"edge_of_an_arc", "asin(x) - y", {1, 1.5, 0}, 0.5, 0.1},
    {"edges_of_a_cube", "max(max(abs(x), abs(y)), abs(z)) = 1", {1, 1, 0.5}, 1, 0.5},
    {"a_fold", "abs(x) + abs(y) = z", {0, 0, 0}, 1e-2, 0.5},
    {"x_500", "x^500 + y^500 + z^500 = 1", {0.98, 0.98, 0}, 0.1, 0.5},
    {"a_corner_of_x_500", "x^500 + y^500 + z^500 = 1", {0.999, 0.999, 0.999}, 1e-3, 0.2},
    {"exp_overflows", "exp(x^8) + y^2 + z^2 = 3", {1, 0, 0}, 2, 0.2},
    {"exp_overflows_to_a_difference", "exp(x^8) - exp(y^8) + z", {1, 1, 0}, 2, 0.0},
    {"jumps", "mod(x, 1) - 1/2 + 0*y", {0, 0, 0}, 1, 0.0},
    {"two_halves", "if(x < 0, y - 1/2, y + 1/2)", {0, 0, 0}, 1, 0.1},
    {"steep", "cbrt(x) + y/8", {0, 0, 0}, 1, 0.3},
    {"fast_waves", "sin(200*x) + y", {0, 0, 0}, 0.1, 0.2},
};

INSTANTIATE_TEST_SUITE_P(Scenes, Samples, testing::ValuesIn(others), place_name);

// Lines that lie in a cubic: f is 0 all along, or nearly, where the line is not of doubles.
TEST(Lines, are_not_certified) {
  struct Line {
    const char* source;
    Ray ray;
  };
  const Line lines[] = {
      {cayley, {{-1, 0, 0}, {1, 0, 0}, 0, 2}},
      {cayley, {{0, 0, -0.7}, {0, 0, 1}, 0, 1.4}},
      {clebsch, {{-1, 1, -1}, {0, -1, 1}, 0, 2}},
      {clebsch, {{0, -0.5, 1.5}, {0, 1, -1}, 0, 2}},
      {clebsch, {{1, 0.25, 1.75}, {0, 1, -1}, -1, 1}},
      {clebsch, {{0.5, 0, 0.5}, {-1, 0, 1}, -1, 1}},
      {steiner, {{0, 0, -0.5}, {0, 0, 1}, 0, 1}},
      {umbrella, {{0, 0, -2}, {0, 0, 1}, 0, 4}},
      {"x*y + z", {{0, -1, 0}, {0, 1, 0}, 0, 2}},
      {"x^3 + y^3 + z^3 - (x + y + z)^3", {{0.25, -1, 1}, {0, 1, -1}, 0, 2}},
  };
  std::map<std::string_view, std::vector<Ray>> by_source;
  for (const Line& line : lines) by_source[line.source].push_back(line.ray);
  for (const auto& [source, rays] : by_source) {
    const Model model = test::model_of(std::string(source));
    const Program& f = model.surfaces[0].f;
    for (const test::Way& way : test::ways({"auto", "ia"})) {
      const auto cast = test::caster(model, way);
      if (!cast) continue;
      for (const Ray& ray : rays) {
        EXPECT_EQ((*cast)(ray).verdict, verdict_undecided) << way.name() << ": " << test::to_text(ray);
        std::vector<Ray> beside;
        for (int k = 4; k < 60; k += 2) {
          beside.push_back(ray);
          beside.back().o[1] += std::ldexp(1.0, -k);
          beside.back().o[2] += std::ldexp(1.25, -k);
        }
        const auto answers = (*cast)(beside);
        for (std::size_t i = 0; i < beside.size(); ++i)
          EXPECT_EQ(test::exact_mistake(f, beside[i], answers[i]), "")
              << way.name() << ": " << test::to_text(beside[i]);
      }
    }
  }
}

// Rays that pass the middle of a ball at 1 + 2^-k and 1 - 2^-k.
TEST(Grazing, a_ball) {
  const Model model = test::model_of(ball);
  std::vector<Ray> rays;
  for (int k = 1; k < 60; ++k)
    for (const double sign : {-1.0, 1.0}) {
      const double aside = 1 + sign * std::ldexp(1.0, -k);
      rays.push_back({{-2, aside, 0}, {1, 0, 0}, 0, 4});
      rays.push_back({{-2, 0.6 * aside, 0.8 * aside}, {1, 0, 0}, 0, 4});
      rays.push_back({{aside, -2, -3}, {0, 2, 3}, 0, 2});
    }
  for (const test::Way& way : test::ways({"auto", "ia"})) {
    const auto cast = test::caster(model, way);
    if (!cast) continue;
    const auto answers = (*cast)(rays);
    for (std::size_t i = 0; i < rays.size(); ++i)
      EXPECT_EQ(test::exact_mistake(model.surfaces[0].f, rays[i], answers[i]), "")
          << way.name() << ": " << test::to_text(rays[i]);
    for (std::size_t i = 0; i < 18; ++i)
      EXPECT_NE(answers[i].verdict, verdict_undecided) << way.name() << ": " << test::to_text(rays[i]);
  }
}

}  // namespace
}  // namespace imp
