// Rays made to be answered wrongly. Each row says which verdicts are right, and why.
#include <gtest/gtest.h>

#include <limits>
#include <map>

#include "ir/infinity.h"
#include "tests/runtime/hard_surfaces.h"
#include "tests/support/cast.h"

namespace imp {
namespace {

using test::ball;
using test::double_pole;
using test::kissing_balls;
using test::pole;
using test::Ray;
using test::shell;
using test::steiner;
using test::teardrop;
using test::umbrella;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct Row {
  const char* name;
  const char* source;
  Ray ray;
  const char* allowed;  // h: hit, m: miss, u: undecided
  double root;          // of a hit
  const char* why;
};

// Rays along an axis that begin at (x, y, z).
Ray along_x(double x, double y, double z, double tmax) { return {{x, y, z}, {1, 0, 0}, 0, tmax}; }
Ray along_y(double x, double y, double z, double tmax) { return {{x, y, z}, {0, 1, 0}, 0, tmax}; }
Ray along_z(double x, double y, double z, double tmax) { return {{x, y, z}, {0, 0, 1}, 0, tmax}; }
constexpr Ray around_zero{{0, 0, 0}, {1, 0, 0}, -1.3, 2};  // t is x

constexpr const char* edge = "sqrt(x) + y";
constexpr const char* cliff = "if(x < 0, -1, 1)";
constexpr const char* jump = "floor(x) + 1/2";
constexpr const char* steep = "x^500 + y^4 + z^4 - 1";
constexpr const char* huge = "1e30*x^4 + 1e30*y^4 - 1e30";
constexpr const char* tiny = "1e-30*(x^2 + y^2 + z^2 - 1)";
constexpr const char* far_away = "(x - 1e6)^2 + y^2 + z^2 = 1";

const Row hard_rays[] = {
    {"through_a_ball", ball, along_x(-3, 0.25, 0, 6), "h", 3 - 0.96824583655185422, "an ordinary root"},
    {"beside_a_ball", ball, along_x(-3, 1.01, 0, 6), "m", 0, "nothing there"},
    {"grazing_from_within", ball, along_x(-3, 0.99999, 0, 6), "hu", 3 - 0.0044721247741,
     "two roots 0.009 apart"},
    {"grazing_from_without", ball, along_x(-3, 1.0001, 0, 6), "mu", 0, "an almost-root"},
    {"touching", ball, along_x(-3, 1, 0, 6), "u", 0, "a double root"},
    {"two_roots_very_close", ball, along_x(-3, 1 - 1e-13, 0, 6), "hu", 3 - 4.4721e-7, "two roots 1e-6 apart"},
    {"backwards", ball, {{-3, 0, 0}, {1, 0, 0}, -1, 1}, "m", 0, "the segment ends before the ball"},
    {"long_direction", ball, {{-3, 0, 0}, {1e6, 0, 0}, 0, 6e-6}, "h", 2e-6, "t counts in directions"},
    {"beginning_inside", ball, along_x(0, 0, 0, 6), "h", 1, "out through the other side"},
    {"ending_inside", ball, along_x(-0.5, 0, 0, 0.75), "m", 0, "inside all along"},
    {"beginning_on_the_surface", ball, along_x(-1, 0, 0, 0.5), "u", 0,
     "no sign before the root: no change is seen"},
    {"ending_on_the_surface", ball, along_x(-2, 0, 0, 1), "u", 0, "no sign behind the root"},
    {"along_a_line_in_it", "x*y + z", along_x(0, 0, 0, 1), "u", 0, "f is 0 all along"},
    {"in_a_plane", "z", along_x(-1, 0, 0, 2), "u", 0, "f is 0 all along"},
    {"everywhere", "0*x", along_x(-1, 0, 0, 2), "u", 0, "f is 0 in space"},
    {"nowhere", "x^2 + 1", along_x(-1, 0, 0, 2), "m", 0, "f has no zeros"},
    {"where_two_balls_touch", kissing_balls, along_y(0, -2, 0, 4), "u", 0, "a root of multiplicity four"},
    {"beside_where_they_touch", kissing_balls, along_y(1e-3, -2, 0, 4), "hu", 1.95529, "roots 0.09 apart"},
    {"through_both", kissing_balls, along_x(-3, 0, 0, 6), "h", 1, "then a double root"},
    {"thin_shell", shell, along_x(-3, 0, 0, 6), "hu", 2,
     "a second root at 2.0001, a sixtieth of a thousandth"},
    {"along_the_handle", umbrella, along_z(0, 0, -2, 1), "u", 0, "x^2 - y^2 z is 0 on the z axis"},
    {"across_the_handle", umbrella, along_x(-1, 0, -1, 2), "u", 0, "x^2: touched, not crossed"},
    {"beside_the_handle", umbrella, along_x(-1, 0.5, -1, 2), "m", 0, "x^2 + 1/4"},
    {"through_the_umbrella", umbrella, along_x(-1, 0.5, 1, 2), "h", 0.5, "x^2 - 1/4"},
    {"across_an_axis", steiner, along_x(-0.5, 0, -0.3, 1), "u", 0, "z^2 x^2: touched, not crossed"},
    {"along_an_axis", steiner, along_z(0, 0, -0.7, 1.4), "u", 0, "f is 0 all along"},
    {"across_the_whisker", teardrop, along_y(0, -1, 0, 2), "u", 0, "-y^2: touched, not crossed"},
    {"along_the_whisker", teardrop, along_x(-0.5, 0, 0, 1), "u", 0,
     "x^4 (x + 1)/2: a root of multiplicity four"},
    {"into_the_drop", teardrop, along_y(-0.5, -1, 0, 2), "h", 1 - 0.125, "y^2 = 1/64"},
    {"across_a_pole", pole, along_x(-1, 0, 0, 2.5), "m", 0, "a change of sign that is no root"},
    {"across_a_pole_to_a_root", pole, along_x(-1, -1, 0, 2.5), "h", 2, "1/x = 1, behind the pole"},
    {"across_a_pole_of_tan", "tan(x) + y", along_x(1, -5, 0, 1), "h", 0.37340076694501583,
     "atan(5) before pi/2"},
    {"beside_a_pole_of_tan", "tan(x) + y", along_x(1.4, 1, 0, 0.5), "m", 0, "the sign changes at pi/2"},
    {"beyond_a_pole", pole, along_x(0.5, -1, 0, 2.5), "h", 0.5, "1/x = 1"},
    {"before_a_pole", pole, along_x(-3, 0.5, 0, 2), "h", 1, "1/x = -1/2"},
    {"across_a_double_pole", double_pole, along_x(-1, 1, 0, 3), "mu", 0, "1/x^2 + 1 > 0 where it is defined"},
    {"starting_on_a_pole", pole, along_x(0, 1, 0, 2), "mu", 0, "f is not defined there"},
    {"at_the_edge_of_a_domain", edge, along_x(-1, 0, 0, 2), "u", 0, "sqrt(x) is 0 at 0, and nothing before"},
    {"into_a_domain", edge, along_x(-1, -0.5, 0, 2), "h", 1.25, "sqrt(x) = 1/2; without a value before 0"},
    {"outside_a_domain", edge, along_x(-3, -1, 0, 2), "m", 0, "no value, no zero"},
    {"beside_a_power_without_a_value", "4*x^3 - 3*x + log(x - 5)^0 - 1.2", around_zero, "m", 0,
     "no value before 5"},
    {"across_a_power_without_a_value", "4*x^3 - 3*x + (1/x)^0 - 1", along_x(-0.5, 0, 0, 1), "mu", 0,
     "no value at 0, where a root would be"},
    {"beside_a_polynomial_without_a_value", "4*x^3 - 3*x + T(0, log(x - 5)) - 1.2", around_zero, "m", 0,
     "no value before 5"},
    {"of_a_choice_without_a_value", "min(sqrt(0 - 1), 2) - x - 1.5", around_zero, "h", 0.5,
     "min is its second operand"},
    {"of_a_power_that_is_whole", "x^(0.3/0.1) + 0.125", around_zero, "h", -0.5, "the exponent is 3"},
    {"of_a_power_that_is_even", "x^(0.1*20) - 0.25", around_zero, "h", -0.5, "the exponent is 2"},
    {"of_a_power_by_a_remainder", "x^(mod(5, 3)) - 0.25", around_zero, "h", -0.5, "the exponent is 2"},
    {"of_a_power_by_a_root", "x^(sqrt(4)) - 0.25", around_zero, "h", -0.5, "the exponent is 2"},
    {"of_a_real_power", "x^(1/3) + 0.125", around_zero, "m", 0, "no value below 0"},
    {"across_a_step", cliff, along_x(-1, 0, 0, 2), "u", 0, "the sign jumps"},
    {"across_a_jump", jump, along_x(-1.5, 0, 0, 2), "u", 0, "the sign jumps at 0"},
    {"x_500", steep, along_x(-3, 0, 0, 6), "h", 2, "3^500 overflows float"},
    {"x_500_far", steep, along_x(-300, 0, 0, 600), "hu", 299, "300^500 overflows double"},
    {"x_500_off_axis", steep, along_x(-3, 0.5, 0, 6), "hu", 3 - std::pow(0.9375, 1.0 / 500), "alike"},
    {"beyond_float", huge, along_x(-1e3, 0, 0, 2e3), "hu", 999, "1e30 1e12 overflows float"},
    {"beyond_float_miss", huge, along_x(-1e3, 1.5, 0, 2e3), "mu", 0, "alike"},
    {"below_float", tiny, along_x(-3, 0, 0, 6), "h", 2, "f is small, its sign is not"},
    {"eye_far_away", ball, along_x(-1e6, 0, 0, 2e6), "hu", 1e6 - 1, "a ball of a millionth of the segment"},
    {"eye_far_away_near_piece",
     ball,
     {{-1e6, 0, 0}, {1, 0, 0}, 1e6 - 2, 1e6 + 2},
     "h",
     1e6 - 1,
     "the segment counts"},
    {"ball_far_away", far_away, along_x(1e6 - 3, 0, 0, 6), "hu", 2, "float: 1/16 between numbers"},
    {"ball_far_away_miss", far_away, along_x(1e6 - 3, 3, 0, 6), "mu", 0, "alike"},
    {"empty_segment", ball, {{-3, 0, 0}, {1, 0, 0}, 1, 1}, "m", 0, "a point outside"},
    {"empty_segment_inside", ball, {{0, 0, 0}, {1, 0, 0}, 0.5, 0.5}, "m", 0, "a point inside: f < 0"},
    {"empty_segment_on_it", ball, {{-3, 0, 0}, {1, 0, 0}, 2, 2}, "u", 0, "a point of the surface"},
    {"segment_backwards", ball, {{-3, 0, 0}, {1, 0, 0}, 6, 0}, "m", 0, "tmin > tmax: no points"},
    {"no_direction", ball, {{-3, 0, 0}, {0, 0, 0}, 0, 6}, "m", 0, "a point outside"},
    {"no_direction_on_it", ball, {{1, 0, 0}, {0, 0, 0}, 0, 6}, "u", 0, "a point of the surface"},
    {"nan_origin", ball, {{nan, 0, 0}, {1, 0, 0}, 0, 6}, "u", 0, "no number, no proof"},
    {"nan_direction", ball, {{-3, 0, 0}, {1, nan, 0}, 0, 6}, "u", 0, "alike"},
    {"nan_tmin", ball, {{-3, 0, 0}, {1, 0, 0}, nan, 6}, "u", 0, "alike"},
    {"nan_tmax", ball, {{-3, 0, 0}, {1, 0, 0}, 0, nan}, "u", 0, "alike"},
    {"endless", ball, along_x(-3, 0, 0, infinity), "u", 0, "all that is finite is its first piece"},
    {"endless_miss", "x^2 + y^2 + z^2 + 1", along_x(-3, 0, 0, infinity), "mu", 0, "f >= 1"},
    {"endless_backwards", "x", {{-3, 0, 0}, {1, 0, 0}, -infinity, infinity}, "u", 0, "no first piece"},
    {"infinite_origin", ball, along_x(infinity, 0, 0, 6), "mu", 0, "nothing out there"},
    {"infinite_direction", ball, {{-3, 0, 0}, {infinity, 0, 0}, 0, 1}, "u", 0, "as endless"},
    {"beyond_double",
     ball,
     {{-1e300, 0, 0}, {1e300, 0, 0}, 0, 2},
     "hu",
     1,
     "beyond float; a speck in double, found by who looks at the middle"},
    {"denormal_direction", ball, {{-3, 0, 0}, {1e-310, 0, 0}, 0, 1}, "m", 0, "hardly moves"},
    {"denormal_direction_far",
     ball,
     {{-3, 0, 0}, {1e-310, 0, 0}, 0, 5e307},
     "mu",
     0,
     "3 - 0.005: never there"},
};

// A mistake in words, or nothing.
std::string mistake(const Row& row, const test::Answer& answer) {
  const char letter = answer.verdict == verdict_hit ? 'h' : answer.verdict == verdict_miss ? 'm' : 'u';
  if (!std::string_view(row.allowed).contains(letter)) return std::string("answered ") + letter;
  if (letter == 'h' && !(std::abs(answer.t - row.root) <= 2e-5 * (row.ray.tmax - row.ray.tmin)))
    return "t is " + std::to_string(answer.t);
  if (letter == 'm' && !std::isnan(answer.t)) return "a miss with a place";
  return "";
}

std::map<std::string, std::vector<const Row*>> rows_by_source() {
  std::map<std::string, std::vector<const Row*>> result;
  for (const Row& row : hard_rays) result[row.source].push_back(&row);
  return result;
}

TEST(HardRays, are_answered_right) {
  for (const auto& [source, cases] : rows_by_source())
    for (const Type precision : {f32, f64})
      for (const Backend backend : {Backend::llvm, Backend::interpreter}) {
        const test::Caster cast(test::model_of(source), {.backend = backend, .precision = precision});
        for (const Row* row : cases)
          EXPECT_EQ(mistake(*row, cast(row->ray)), "")
              << row->name << ", " << to_text(precision) << ", "
              << (backend == Backend::llvm ? "llvm: " : "interpreter: ") << row->why;
      }
}

// Of the other strategies some take polynomials only, and some leave more undecided, which is never wrong.
TEST(HardRays, are_answered_right_by_every_strategy) {
  for (const Search& search : searches().subspan(1)) {
    int decided = 0, count = 0;
    for (const auto& [source, cases] : rows_by_source())
      for (const Type precision : {f32, f64}) {
        const Model model = test::model_of(source);
        Diagnostics refused;
        if (!cast_program(model.surfaces[0], search, inclusions().front(), {}, precision, refused)) continue;
        const test::Caster cast(model, {.backend = Backend::interpreter, .precision = precision}, {}, {},
                                inclusions().front(), search);
        for (const Row* row : cases) {
          const auto answer = cast(row->ray);
          const bool must = !std::string_view(row->allowed).contains('u');
          count += must;
          if (answer.verdict == verdict_undecided) continue;
          decided += must;
          EXPECT_EQ(mistake(*row, answer), "")
              << row->name << ", " << search.name << ", " << to_text(precision) << ": " << row->why;
        }
      }
    EXPECT_GE(decided, count - 2) << search.name;
  }
}

// Of a parameter that is no number nothing is known.
TEST(HardRays, with_a_parameter_that_is_no_number) {
  const Model model = test::model_of("param r = 1\nx^2 + y^2 + z^2 = r^2*(r - r + 1)");
  for (const double r : {nan, infinity, -infinity})
    for (const Type precision : {f32, f64})
      for (const Ray& ray : {along_x(-3, 0, 0, 6), along_x(-3, 2, 0, 6)})
        EXPECT_EQ(test::Caster(model, {.precision = precision}, {}, {{"r", r}})(ray).verdict,
                  verdict_undecided)
            << r;
}

// The names of what the kernel adds are not taken from the file.
TEST(HardRays, parameters_may_be_called_anything) {
  for (const std::string name : {"s", "t", "h", "ox", "dz", "tmin", "tmax", "verdict", "bisect"}) {
    const Model model = test::model_of("param " + name + " = 2\nx^2 + y^2 + z^2 = " + name + "^2");
    const auto answer = test::Caster(model)(along_x(-3, 0, 0, 6));
    EXPECT_EQ(answer.verdict, verdict_hit) << name;
    EXPECT_NEAR(answer.t, 1, 1e-5) << name;
  }
}

}  // namespace
}  // namespace imp
