// What the Programs look like: exact constants, powers, sharing, spans, names; and the settings.
#include <fstream>
#include <sstream>

#include "tests/frontend/parse.h"

namespace imp {
namespace {

using test::parse;
using test::root;
using test::surface;

TEST(Lowering, keeps_numbers_exact) {
  EXPECT_EQ(root("0.1 + 0"), "add div 0");
  EXPECT_EQ(root("0.1"), "div 1 10");
  EXPECT_EQ(root("11.8"), "div 118 10");
  EXPECT_EQ(root("2.50"), "constant");
  EXPECT_EQ(root("1e20"), "constant");
  EXPECT_EQ(root("1e30"), "powi 10 30");
  EXPECT_EQ(root("3e30"), "mul 3 powi");
  EXPECT_EQ(root("1e-30"), "div 1 powi");
  EXPECT_EQ(root("12345678901234567891"), "add 1.2345e+19 678901234567891");
  EXPECT_EQ(root("9007199254740993"), "add 9000000000000000 7199254740993");
  EXPECT_EQ(root("1234567890123456789012345678901234567890"), "add mul 678901234567890");
}

TEST(Lowering, tells_integer_powers_from_real_ones) {
  EXPECT_EQ(root("x^3"), "powi input 3");
  EXPECT_EQ(root("x^-3"), "powi input -3");
  EXPECT_EQ(root("x^(1 + 2)"), "powi input 3");
  EXPECT_EQ(root("x^(4/2)"), "powi input 2");
  EXPECT_EQ(root("x^2.0"), "powi input 2");
  EXPECT_EQ(root("x^1048576"), "powi input 1048576");
  EXPECT_EQ(root("n = 3\nx^n"), "powi input 3");
  EXPECT_EQ(root("pow(x, 3)"), "powi input 3");
  EXPECT_EQ(root("p(a, n) = a^n\np(x, 4) = 0"), "powi input 4");
  EXPECT_EQ(root("x^y"), "pow input input");
  EXPECT_EQ(root("x^(1/3)"), "pow input div");
  EXPECT_EQ(root("param n = 2\nx^n"), "pow input input");
}

// No double is 0.3, but 0.3/0.1 is 3.
TEST(Lowering, decides_exponents_exactly) {
  EXPECT_EQ(root("x^(0.3/0.1)"), "powi input 3");
  EXPECT_EQ(root("x^(0.1*20)"), "powi input 2");
  EXPECT_EQ(root("x^(0.1 + 0.2 + 0.7)"), "powi input 1");
  EXPECT_EQ(root("x^-(1/3 + 1/6 - 5/2)"), "powi input 2");
  EXPECT_EQ(root("x^mod(5, 3)"), "powi input 2");
  EXPECT_EQ(root("x^mod(-0.5, 0.3)"), "pow input mod");
  EXPECT_EQ(root("x^floor(0.3/0.1)"), "powi input 3");
  EXPECT_EQ(root("x^ceil(0.3/0.1)"), "powi input 3");
  EXPECT_EQ(root("x^floor(-1/3)"), "powi input -1");
  EXPECT_EQ(root("x^max(1/3, min(0.3/0.1, 7/2))"), "powi input 3");
  EXPECT_EQ(root("x^(3*sign(-1/3))"), "powi input -3");
  EXPECT_EQ(root("x^|-6/3|"), "powi input 2");
  EXPECT_EQ(root("x^sqrt(4)"), "powi input 2");
  EXPECT_EQ(root("x^sqrt(0.09*100)"), "powi input 3");
  EXPECT_EQ(root("x^(27/8)^(1/3)"), "pow input pow");
  EXPECT_EQ(root("x^(2*(27/8)^(1/3))"), "powi input 3");
  EXPECT_EQ(root("x^cbrt(-8)"), "powi input -2");
  EXPECT_EQ(root("x^(1/4)^-0.5"), "powi input 2");
  EXPECT_EQ(root("x^0.5^-2"), "powi input 4");
  EXPECT_EQ(root("x^if(0.3 <= 0.1*3, 2, log(2))"), "powi input 2");
  EXPECT_EQ(root("x^if(not (0.3 < 0.1*3 or 1 > 2), 2, 5)"), "powi input 2");
  EXPECT_EQ(root("x^sum(i, 1, 3, i/3)"), "powi input 2");
  EXPECT_EQ(root("x^product(i, 1, 3, i/3 + 1/3)"), "pow input mul");
  EXPECT_EQ(root("n = 0.3\nhalf(a) = a/0.1\nx^half(n)"), "powi input 3");
  EXPECT_EQ(root("x^(1e-300*1e300)"), "powi input 1");
  EXPECT_EQ(root("x^(9007199254740993 - 9007199254740992)"), "powi input 1");
  EXPECT_EQ(root("x^(1/0)"), "pow input div");
  EXPECT_EQ(root("x^0.3"), "pow input div");
  EXPECT_EQ(root("x^(2 + 1e-20)"), "pow input add");
}

TEST(Lowering, decides_bounds_and_degrees_exactly) {
  EXPECT_EQ(root("sum(i, 0.1*10, 0.3/0.1, i)"), root("sum(i, 1, 3, i)"));
  EXPECT_EQ(root("T(0.3/0.1, x)"), "chebyshev input 3 0");
  EXPECT_EQ(root("T(mod(8, 3), x)"), "chebyshev input 2 0");
}

// What takes more digits than there are is no integer, and takes no time.
TEST(Lowering, bounds_what_it_decides_exactly) {
  EXPECT_EQ(root("x^(0.1^100000*10^100000)"), "pow input mul");
  EXPECT_EQ(root("x^((1/3)^1000000)"), "pow input powi");
  EXPECT_EQ(root("x^(2^1000 - 2^1000 + 2)"), "powi input 2");
  EXPECT_EQ(root("x^sum(i, 1, 14000, 1/i)").substr(0, 9), "pow input");
  EXPECT_EQ(root("x^(4^(1/1048577) + 2^-1048576)").substr(0, 9), "pow input");
}

TEST(Lowering, of_equations_is_left_minus_right) {
  EXPECT_EQ(root("x = y"), "sub input input");
  EXPECT_EQ(root("x*y = 0"), "mul input input");
  EXPECT_EQ(root("x*y = 0*3"), "mul input input");
  EXPECT_EQ(root("x*y"), "mul input input");
  EXPECT_EQ(root("pi"), "mul 4 atan");
}

TEST(Lowering, shares_chebyshev_polynomials) {
  EXPECT_LE(surface("T(1024, x)").graph.size(), 36u);
  EXPECT_LE(surface("T(1023, x)").graph.size(), 70u);
  EXPECT_LE(surface("T(1000, x) + T(1000, x)").graph.size(), 60u);
}

TEST(Lowering, keeps_spans_and_names) {
  const std::string text = "s = x^2 + y^2\nsurface a:\n  s*2 = 1";
  const Program f = surface(text);
  std::string found;
  for (std::uint32_t i = 0; i < f.graph.size(); ++i) {
    const Span span = f.graph.span(Id{i});
    if (!f.graph[Id{i}].args.empty())
      found += std::string(f.graph.name(Id{i})) + '[' + text.substr(span.begin, span.end - span.begin) + ']';
  }
  EXPECT_EQ(found, "[x^2][y^2]s[x^2 + y^2][s*2][a]");
}

TEST(Model, has_every_surface_with_all_inputs) {
  const Model model =
      parse("time t = 0 in [0, 1]\nsurface a: x = u\nsurface b: y = v*t\nparam u = 1\nparam v = 2");
  ASSERT_EQ(model.surfaces.size(), 2u);
  for (const Surface& surface : model.surfaces) {
    std::string inputs;
    for (const Input& input : surface.f.inputs) {
      EXPECT_EQ(input.type, f64);
      EXPECT_EQ(input.rate, inputs.size() < 6 ? Rate::ray : Rate::frame);
      inputs += input.name + ' ';
    }
    EXPECT_EQ(inputs, "x y z u v t ");
    EXPECT_EQ(surface.f.outputs.size(), 1u);
    EXPECT_EQ(surface.f.outputs[0].name, "f");
    EXPECT_EQ(surface.f.name, surface.name);
  }
  EXPECT_EQ(model.surfaces[0].name, "a");
  EXPECT_EQ(parse("x").surfaces[0].name, "surface");
  EXPECT_EQ(test::evaluate(model.surfaces[1].f, {0, 7, 0, 0, 3, 2})[0], 1);
}

// The values of settings, at the parameters and the time given.
class Settings {
 public:
  Settings(const Model& model, std::initializer_list<double> inputs)
      : values_(test::evaluate(model.settings, inputs)) {}
  double operator()(Setting setting) const { return values_.at(setting.output); }
  std::vector<double> operator()(const Point& point) const {
    return {(*this)(point[0]), (*this)(point[1]), (*this)(point[2])};
  }

 private:
  std::vector<double> values_;
};

TEST(Model, has_parameters_and_time) {
  const Model model =
      parse("a = 1/4\nparam w = 2*a in [a, 2]\nparam v = 3\ntime t = 0.5 in [-1, 1]\nx = w*v*t");
  const Settings at(model, {0, 0, 0});
  ASSERT_EQ(model.parameters.size(), 2u);
  EXPECT_EQ(model.parameters[0].name, "w");
  EXPECT_EQ(at(model.parameters[0].value), 0.5);
  EXPECT_EQ(at(model.parameters[0].range->at(0)), 0.25);
  EXPECT_EQ(at(model.parameters[0].range->at(1)), 2);
  EXPECT_EQ(model.parameters[1].name, "v");
  EXPECT_FALSE(model.parameters[1].range);
  ASSERT_TRUE(model.time);
  EXPECT_EQ(model.time->name, "t");
  EXPECT_EQ(at(model.time->value), 0.5);
  EXPECT_EQ(at(model.time->range->at(0)), -1);
}

TEST(Model, has_a_domain) {
  EXPECT_FALSE(parse("x").domain);

  const Model box = parse("x\nparam w = 1\ndomain box((-1, -2, -w), (1, 2*w, 3))");
  EXPECT_EQ(Settings(box, {4})(std::get<Box>(*box.domain).min), (std::vector<double>{-1, -2, -4}));
  EXPECT_EQ(Settings(box, {4})(std::get<Box>(*box.domain).max), (std::vector<double>{1, 8, 3}));

  const Model ball = parse("x\ndomain sphere(radius: 2)");
  EXPECT_EQ(Settings(ball, {})(std::get<Sphere>(*ball.domain).center), (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(Settings(ball, {})(std::get<Sphere>(*ball.domain).radius), 2);

  const Model moved = parse("x\ntime t = 0\ndomain sphere(center: (1, t, 2), radius: t + 1)");
  EXPECT_EQ(Settings(moved, {3})(std::get<Sphere>(*moved.domain).center), (std::vector<double>{1, 3, 2}));
  EXPECT_EQ(Settings(moved, {3})(std::get<Sphere>(*moved.domain).radius), 4);
}

TEST(Model, has_a_camera) {
  EXPECT_FALSE(parse("x").camera);

  const Model perspective = parse("x\ncamera from (3, 2, 4) to (0, 1, 0) fov 30");
  const Settings at(perspective, {});
  EXPECT_EQ(at(perspective.camera->from), (std::vector<double>{3, 2, 4}));
  EXPECT_EQ(at(perspective.camera->to), (std::vector<double>{0, 1, 0}));
  EXPECT_EQ(at(perspective.camera->up), (std::vector<double>{0, 1, 0}));
  EXPECT_EQ(at(perspective.camera->fov.value()), 30);
  EXPECT_FALSE(perspective.camera->height);

  const Model parallel = parse("x\ncamera from (3, 2, 4)\n  to (0, 1, 0)\n  up (0, 0, 1)\n  height 3");
  EXPECT_EQ(Settings(parallel, {})(parallel.camera->up), (std::vector<double>{0, 0, 1}));
  EXPECT_EQ(Settings(parallel, {})(parallel.camera->height.value()), 3);
  EXPECT_FALSE(parallel.camera->fov);
}

TEST(Model, has_lights) {
  const Model model = parse(
      "x\nlight from (1, 2, 3)\nlight direction (0, 0, -1) color (1, 0.5, 0) intensity 2\nlight from (0, 0, "
      "9) intensity 3");
  const Settings at(model, {});
  ASSERT_EQ(model.lights.size(), 3u);
  EXPECT_FALSE(model.lights[0].directional);
  EXPECT_EQ(at(model.lights[0].place), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(at(model.lights[0].color), (std::vector<double>{1, 1, 1}));
  EXPECT_EQ(at(model.lights[0].intensity), 1);
  EXPECT_TRUE(model.lights[1].directional);
  EXPECT_EQ(at(model.lights[1].place), (std::vector<double>{0, 0, -1}));
  EXPECT_EQ(at(model.lights[1].color), (std::vector<double>{1, 0.5, 0}));
  EXPECT_EQ(at(model.lights[1].intensity), 2);
  EXPECT_EQ(at(model.lights[2].intensity), 3);
}

TEST(Model, names_its_settings) {
  const Model model = parse("x\nparam w = 1 in [0, 2]\ndomain sphere(radius: w)\nlight from (1, 2, 3)");
  std::string names;
  for (const Output& output : model.settings.outputs) names += output.name + '\n';
  EXPECT_EQ(
      names,
      "parameter.w\nparameter.w.min\nparameter.w.max\ndomain.center.x\ndomain.center.y\ndomain.center.z\n"
      "domain.radius\nlight1.from.x\nlight1.from.y\nlight1.from.z\nlight1.color.x\nlight1.color.y\n"
      "light1.color.z\nlight1.intensity\n");
}

}  // namespace
}  // namespace imp
