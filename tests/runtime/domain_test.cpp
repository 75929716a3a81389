// What a picture makes of its domain: f is simpler there, and what is enclosed for it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ir/text.h"
#include "runtime/pixel.h"
#include "runtime/search/segment.h"
#include "tests/support/cost.h"
#include "tests/support/effort.h"
#include "tests/support/evaluate.h"
#include "tests/support/picture.h"
#include "tests/support/random.h"

namespace imp::test {
namespace {

const std::string view = "camera from (3, 2, 4) to (0, 0, 0) fov 40\n";
const std::string box = "domain box((-2, -2, -2), (2, 2, 2))\n";
const std::string any_box = "param side = 2\ndomain box((-side, -side, -side), (side, side, side))\n";

RenderOptions small() {
  RenderOptions options = sized(24, 20);
  options.depth = true;
  return options;
}

Program pixel_of(const std::string& text, const RenderOptions& options = sized(4, 4)) {
  Diagnostics diagnostics;
  auto program = pixel_program(model_of(text), options, diagnostics);
  EXPECT_TRUE(program) << to_text(diagnostics);
  return program ? *std::move(program) : Program{};
}

// No certified answer of one is denied by the other, and places are the same. The hits of both.
std::size_t expect_agreement(const Picture& a, const Picture& b, float tolerance) {
  std::size_t hits = 0;
  for (std::size_t i = 0; i < a.verdict.size(); ++i) {
    EXPECT_FALSE(contradict(a.verdict[i], b.verdict[i])) << "pixel " << i;
    if (a.verdict[i] != verdict_hit || b.verdict[i] != verdict_hit) continue;
    EXPECT_NEAR(a.depth[i], b.depth[i], tolerance) << "pixel " << i;
    ++hits;
  }
  return hits;
}

// Twice what each may be off, of rays that are no longer than the diagonal.
constexpr float ray_tolerance = 2 * 1e-5F * 7;

struct Decided {
  const char *f, *plain;
};
constexpr Decided decided[] = {
    {"sqrt(abs(z + 5)) - max(x, -4) - abs(y - 7)/3 = 0\n", "sqrt(z + 5) - x - (-(y - 7))/3 = 0\n"},
    {"if(x < 5, x^2 + y^2, log(x)) + min(z^2, 30 - y) = 1\n", "x^2 + y^2 + z^2 = 1\n"},
    {"x^2 + y^2 + abs(z + 3)*z = sign(z + 7)\n", "x^2 + y^2 + (z + 3)*z = 1\n"},
};

TEST(OverDomain, what_it_decides_is_gone) {
  for (const auto& [f, plain] : decided) {
    SCOPED_TRACE(f);
    EXPECT_EQ(drawn_function(model_of(f + box), 0), drawn_function(model_of(plain + box), 0));
    for (const Op op : {Op::max, Op::min, Op::abs}) {
      EXPECT_EQ(count(drawn_function(model_of(f + box), 0), op), 0);
      EXPECT_LE(count(pixel_of(f + box), op), count(pixel_of(plain + box), op) + 2 * 3);  // of places
    }
    EXPECT_LT(cost(pixel_of(f + box)), cost(pixel_of(f + any_box)));
  }
}

TEST(OverDomain, leaves_what_is_decided_elsewhere_only) {
  for (const std::string& domain : {box, any_box}) {
    const Model model =
        model_of("param p = 0 in [0, 1]\nmax(x, p - 1) + abs(z + 1.9) = abs(y - 2.005)\n" + domain);
    EXPECT_EQ(over_domain(model, model.surfaces[0].f), model.surfaces[0].f);
  }
}

TEST(OverDomain, the_same_picture) {
  for (const auto& [f, plain] : decided)
    for (const bool tiles : {false, true}) {
      SCOPED_TRACE(f);
      RenderOptions options = small();
      options.tiles = tiles;
      const Picture here = render(model_of(f + box + view), options);
      EXPECT_EQ(verdicts(here), verdicts(render(model_of(plain + box + view), options)));
      EXPECT_GT(expect_agreement(here, render(model_of(f + any_box + view), options), ray_tolerance), 30U);
      EXPECT_EQ(here.count(verdict_undecided), 0U);
    }
}

// A parameter may leave its range.
TEST(OverDomain, of_any_parameter) {
  const std::string text = "param p = -8 in [-9, -7]\nmax(x + z/2, p) = y\n" + box + view;
  const Picture beyond = render(model_of(text), small(), {{"p", 0.5}}),
                expected = render(model_of("max(x + z/2, 0.5) = y\n" + box + view), small());
  EXPECT_EQ(verdicts(beyond), verdicts(expected));
  EXPECT_NE(verdicts(beyond), verdicts(render(model_of(text), small())));
}

// From far away rounding carries ends of rays out of the domain, to where bounds do not hold and f may be another function.
TEST(OverDomain, nothing_is_certain_beyond_it) {
  const auto picture = [](const std::string& f, const std::string& from,
                          std::optional<double> economize = {}) {
    RenderOptions options = small();
    options.tiles = false;
    options.economize = economize;
    return render(model_of(f + " = 0\ndomain box((-2.3, -2.3, -2.3), (2.3, 2.3, 2.3))\ncamera from " + from +
                           " to (0, 0, 0) height 3\n"),
                  options);
  };
  const std::string near = "(3, 7, 10)", far = "(3e5, 7e5, 1e6)";
  EXPECT_EQ(verdicts(picture("max(z, -4)", near)), verdicts(picture("z", near)));
  EXPECT_EQ(picture("z", near).count(verdict_undecided), 0U);
  for (const char* f : {"z", "max(z, -4)", "z + x^4/1e9"}) {
    EXPECT_GT(picture(f, far).count(verdict_undecided), 100U) << f;
    EXPECT_GT(picture(f, far, 1e-3).count(verdict_undecided), 100U) << f;
  }
}

// Squares of its radius are no floats, so that no ray has an end.
TEST(OverDomain, proves_nothing_of_what_overflows) {
  const Model model = model_of(
      "x^2 + y^2 + z^2 = 1/2\ndomain sphere(radius: 1e20)\ncamera from (0.3, 0.2, 5) to (0, 0, 0) fov 30\n");
  for (const bool tiles : {false, true}) {
    RenderOptions options = small();
    options.tiles = tiles;
    const Picture picture = render(model, options);
    EXPECT_EQ(picture.count(verdict_undecided), picture.verdict.size()) << tiles;
  }
}

// Whatever segment lies in the box with its margin, its numbers lie in the ranges that bounds rely on.
TEST(OverDomain, ranges_hold_every_segment_within_the_margin) {
  Random random(2);
  Program f{.name = "f"};
  for (const char* name : {"x", "y", "z"}) add_input(f, name, f64, Rate::ray);
  for (int i = 0; i < 1000; ++i) {
    SpaceBounds space;
    for (Range& axis : space) {
      axis.lo = random.between(-10, 10);
      axis.hi = axis.lo + std::ldexp(random.between(1, 2), static_cast<int>(random.below(8)) - 4);
    }
    const auto ranges = ranges_along_ray(space, f);
    ASSERT_EQ(ranges.size(), 7U);
    const SpaceBounds places = with_margin(space);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LE(ranges[1 + k].lo, places[k].lo);
      EXPECT_GE(ranges[1 + k].hi, places[k].hi);
      EXPECT_GE(ranges[4 + k].hi, places[k].hi - places[k].lo);
      EXPECT_LE(ranges[4 + k].lo, places[k].lo - places[k].hi);
    }
  }
}

// A segment of f32 numbers whose ends lie about those of the box.
TEST(OverDomain, knows_which_segments_lie_in_a_box) {
  Random random(1);
  int within = 0;
  for (std::size_t i = 0; i < effort(4000); ++i) {
    std::array<double, 3> o{}, d{};
    SpaceBounds space;
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      o[k] = static_cast<float>(random.between(-2, 2)), d[k] = static_cast<float>(random.between(-2, 2));
      const auto beside = [&](double end) { return end + std::ldexp(random.between(-1, 8), -24); };
      space[k] = {-beside(-std::min(o[k], o[k] + d[k])), beside(std::max(o[k], o[k] + d[k]))};
      for (const double end : {o[k], o[k] + d[k]})
        inside = inside && space[k].lo <= end && end <= space[k].hi;
    }
    Program program;
    const auto input = [&](const char* name) {
      return Expr{&program.graph, add_input(program, name, f32, Rate::ray)};
    };
    const std::array<Expr, 3> origin{input("ox"), input("oy"), input("oz")},
        way{input("dx"), input("dy"), input("dz")};
    const Truth in = lies_in(segment_of_numbers(origin, way, zero(way[0]), one(way[0])), space);
    program.outputs.push_back({"in", in.id});
    const double answer = evaluate(program, {o[0], o[1], o[2], d[0], d[1], d[2]})[0];
    within += answer != 0;
    ASSERT_TRUE(inside || answer == 0) << i;
    ASSERT_EQ(evaluate(program, {o[0], NAN, o[2], d[0], d[1], d[2]})[0], 0);
  }
  EXPECT_GT(within, effort(200));
}

// cos, cut short behind x^20.
std::string cosine(const std::string& x) {
  std::string text = "1";
  double factorial = 1;
  for (unsigned i = 2; i <= 20; i += 2)
    text += fmt::format(" {} {}^{}/{:.17g}", i % 4 == 0 ? '+' : '-', x, i, factorial *= i * (i - 1));
  return text;
}

const std::string cosines = cosine("x") + " + " + cosine("y") + " + " + cosine("z") + " = 0.5\n";

TEST(Economized, makes_kernels_shorter) {
  RenderOptions options = small();
  options.wish.search = search_named("stackless");
  for (const char* inclusion : {"ia", "af1", "slope"}) {
    options.wish.inclusion = inclusion_named(inclusion);
    options.economize.reset();
    std::size_t last = cost(pixel_of(cosines + box, options));
    for (const double tolerance : {1e-9, 1e-5}) {
      options.economize = tolerance;
      const std::size_t now = cost(pixel_of(cosines + box, options));
      EXPECT_LT(now, last) << inclusion << ' ' << tolerance;
      last = now;
    }
  }
}

TEST(Economized, leaves_what_cannot_be_cut) {
  RenderOptions options = small();
  for (const std::string f :
       {"T(14, x) + T(14, y) + T(14, z) = 0\n", "x^2 + y^2 + z^2 = 1\n", "sin(x) = y*z\n"}) {
    options.economize.reset();
    const Program before = pixel_of(std::string(f) + box, options);
    options.economize = 1e-6;
    EXPECT_EQ(imp::to_text(pixel_of(std::string(f) + box, options)), imp::to_text(before));
  }
}

TEST(Economized, needs_a_domain) {
  RenderOptions options = small();
  options.economize = 1e-6;
  Diagnostics diagnostics;
  EXPECT_FALSE(Renderer::make(model_of("x^20 = y\n" + any_box), options, diagnostics));
  EXPECT_TRUE(to_text(diagnostics).contains("--economize needs a domain that does not depend on parameters"));
}

TEST(Economized, certified_answers_agree) {
  const std::string scenes[] = {
      cosine("x") + " = y + z*x/4\n" + box,
      cosines + "domain sphere(radius: 2)\n",
      "param p = 0.25\nx^14/100 + y^9/1e3 - z^3 + p*x^7/90 = p\n" + box,
      "y - (" + cosine("x") + ")/z = 0\n" + box,
      "T(6, x/2) + T(5, y)*1e-4 + z^8/1e4 = z\n" + box,
  };
  std::size_t agreed = 0;
  for (const std::string& scene : scenes)
    for (const auto& [search, tolerance] : {std::pair{"stackless", 1e-6}, {"isolate", 1e-2}}) {
      SCOPED_TRACE(scene + search);
      RenderOptions options = small();
      options.wish.search = search_named(search);
      options.tiles = &scene == scenes;
      const Picture before = render(model_of(scene + view), options);
      options.economize = tolerance;
      const Picture after = render(model_of(scene + view), options);
      agreed += expect_agreement(after, before, ray_tolerance);
      EXPECT_LE(after.count(verdict_undecided), before.count(verdict_undecided) + 4);
    }
  EXPECT_GT(agreed, 500U);
}

// Where the ray does not leave the domain: enclosures of pieces and of points within them.
TEST(Economized, holds_the_values_of_f) {
  Random random(7);
  int cuts = 0;
  for (std::size_t i = 0; i < effort(120); ++i) {
    std::string text = "0.5";
    for (const char* variable : {"x", "y", "z"})
      for (unsigned k = 1; k < 14; ++k)
        if (!random.one_in(3))
          text += fmt::format(" + {}*{}^{}", random.between(-1, 1) * std::exp2(-1.5 * k), variable, k);
    const Program f = model_of(text + (random.one_in(2) ? " + x*y/3 = sin(z)\n" : " = 0\n")).surfaces[0].f;
    SpaceBounds space;
    for (Range& side : space) side = {random.between(-2, 0), random.between(0.1, 2)};

    for (const Type type : {f32, f64}) {
      Program program;
      const auto input = [&](const std::string& name) {
        return Expr{&program.graph, add_input(program, name, type, Rate::ray)};
      };
      const std::array<Expr, 3> o{input("ox"), input("oy"), input("oz")},
          d{input("dx"), input("dy"), input("dz")};
      const Expr lo = input("lo"), hi = input("hi"), at = input("at");
      const Inclusion& inclusion = inclusions()[i % inclusions().size()];
      Diagnostics diagnostics;
      const auto ray = ray_function(f, segment_of_numbers(o, d, zero(lo), one(lo)), {}, inclusion,
                                    SearchSpace{space, std::pow(10, random.between(-7, -1))}, diagnostics);
      if (!ray) continue;  // no polynomial, for Bernstein coefficients
      const Interval bound = ray->bound(interval(-lo, hi)), value = ray->bound_at(at);
      program.outputs = {{"nlo", bound.nlo.id},
                         {"hi", bound.hi.id},
                         {"value.nlo", value.nlo.id},
                         {"value.hi", value.hi.id},
                         {"certain", ray->certain.id}};
      const auto kernel = make_kernel(program, {.backend = Backend::interpreter, .precision = type}).value();
      cuts += ray->certain.graph->truth_value(ray->certain.id) != true;
      for (int n = 0; n < 40; ++n) {
        std::vector<double> numbers;
        for (const Range& side : space) numbers.push_back(random.between(side.lo, side.hi));
        for (std::size_t k = 0; k < 3; ++k)
          numbers.push_back(0.999 * (random.between(space[k].lo, space[k].hi) - numbers[k]));
        const double a = random.unit(), b = random.one_in(2) ? a : random.between(a, 1);
        numbers.insert(numbers.end(), {a, b, random.one_in(2) ? a : b});
        if (type == f32)
          for (double& number : numbers) number = static_cast<float>(number);
        const auto result = evaluate(*kernel, numbers);
        EXPECT_EQ(result[4], 1);
        EXPECT_LE(-result[0], result[3]) << text;
        EXPECT_LE(-result[2], result[1]) << text;
      }
    }
  }
  EXPECT_GT(cuts, effort(100));
}

}  // namespace
}  // namespace imp::test
