// Parameters, settings and the numbers of a frame.
#include "runtime/numbers.h"

#include <gtest/gtest.h>

#include <cmath>

#include "runtime/view.h"
#include "tests/support/catalogue.h"

namespace imp {
namespace {

using Triple = std::array<double, 3>;

constexpr const char* with_parameters = R"(
param wide = sqrt(2)^2 in [1/2, 4]
time now = 3 in [0, 10]
param high = wide_constant/4
wide_constant = 6
x^2 + wide*y^2 + high*z^2 = now
domain sphere(center: (wide, -high, 0.1), radius: wide*high + now)
camera from (wide^2, 0, 5) to (0, 0, high) fov 10*wide
)";

struct Read {
  std::optional<UniformValues> values;
  std::string complaints;
};

Read read(const std::string& source, const std::vector<Override>& overrides,
          std::optional<double> time = {}) {
  Diagnostics diagnostics;
  const auto model = parse_model(source, "test.imp", diagnostics);
  EXPECT_TRUE(model.has_value()) << to_text(diagnostics);
  auto values = uniform_values(model.value(), overrides, time, diagnostics);
  return {std::move(values), to_text(diagnostics)};
}

void expect_says(const Read& read, const char* part) {
  EXPECT_TRUE(read.complaints.contains(part)) << read.complaints;
}

TEST(UniformValues, are_the_defaults_in_the_order_of_the_file_then_the_time) {
  EXPECT_EQ(uniform_names(test::model_of(with_parameters)),
            (std::vector<std::string>{"wide", "high", "now"}));
  const Read defaults = read(with_parameters, {});
  EXPECT_EQ(defaults.values.value(), (UniformValues{2, 1.5, 3}));
  EXPECT_EQ(defaults.complaints, "");
}

TEST(UniformValues, change_by_name) {
  EXPECT_EQ(read(with_parameters, {{"high", 7}}, 4).values.value(), (UniformValues{2, 7, 4}));
  EXPECT_EQ(read(with_parameters, {{"high", 7}, {"high", 8}}).values.value(), (UniformValues{2, 8, 3}))
      << "the last one wins";
  EXPECT_EQ(read(with_parameters, {{"now", 5}}).values.value(), (UniformValues{2, 1.5, 5}))
      << "the time by its name";
}

TEST(UniformValues, outside_their_range_are_warned_of) {
  const Read far = read(with_parameters, {{"wide", 5}}, 11);
  EXPECT_EQ(far.values.value(), (UniformValues{5, 1.5, 11}));
  expect_says(far, "test.imp:2:7: warning: 5 is outside the range of 'wide', [0.5, 4]");
  expect_says(far, "warning: 11 is outside the range of 'now', [0, 10]");
  expect_says(read(with_parameters, {{"wide", NAN}}), "outside the range");
  EXPECT_EQ(read(with_parameters, {{"wide", 4}, {"wide", 0.5}, {"high", -1e9}}).complaints, "");
}

TEST(UniformValues, unknown_names_are_errors) {
  const Read wrong = read(with_parameters, {{"hihg", 1}});
  EXPECT_FALSE(wrong.values);
  expect_says(wrong, "error: the file has no parameter 'hihg'; did you mean 'high'?");
  EXPECT_FALSE(read(with_parameters, {{"wide_constant", 1}}).values) << "a constant is no parameter";

  EXPECT_TRUE(uniform_names(test::model_of("x")).empty());
  EXPECT_TRUE(read("x", {}).values.value().empty());
  expect_says(read("x", {{"r", 1}}), "no parameter 'r'; 'param NAME = VALUE' would make one");
  expect_says(read("x", {}, 1), "has no time");
}

TEST(Numbers, follow_parameters_and_time) {
  const Model model = test::model_of(with_parameters);
  const Numbers numbers(model, {3, 2, 10});
  const auto& sphere = std::get<Sphere>(model.domain.value());
  EXPECT_EQ(numbers(sphere.center), (Triple{3, -2, 0.1}));
  EXPECT_EQ(numbers(sphere.radius), 16);
  EXPECT_EQ(numbers(model.camera->from), (Triple{9, 0, 5}));
  EXPECT_EQ(numbers(model.camera->up), (Triple{0, 1, 0}));
  EXPECT_EQ(numbers(model.camera->fov.value()), 30);
}

// The numbers of a frame of a file, as vectors.
class Frame {
 public:
  explicit Frame(const std::string& source, std::size_t width = 40, std::size_t height = 20) {
    const Model model = test::model_of(source);
    Diagnostics diagnostics;
    const Numbers numbers(model, uniform_values(model, {}, std::nullopt, diagnostics).value());
    values_ = frame_values(model, numbers, width, height);
  }
  float number(const std::string& name) const { return values_.at(name); }
  Triple operator()(const std::string& name, const char* parts = "xyz") const {
    Triple v;
    for (std::size_t i = 0; i < 3; ++i) v[i] = values_.at(name + "." + parts[i]);
    return v;
  }
  // From the eye to a place in the picture.
  Triple at(double i, double j) const {
    Triple v = (*this)("corner");
    for (std::size_t k = 0; k < 3; ++k) v[k] += i * (*this)("right")[k] + j * (*this)("down")[k];
    return v;
  }
  const std::map<std::string, float>& all() const { return values_; }

 private:
  std::map<std::string, float> values_;
};

double dot(const Triple& a, const Triple& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Triple& a) { return std::sqrt(dot(a, a)); }

void expect_near(const Triple& a, const Triple& b, double tolerance = 1e-6) {
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(a[i], b[i], tolerance) << testing::PrintToString(a) << ", not " << testing::PrintToString(b);
}

void expect_orthonormal(const Frame& frame) {
  const Triple forward = frame("forward"), right = frame("right"), down = frame("down");
  EXPECT_NEAR(length(forward), 1, 1e-6);
  EXPECT_NEAR(length(right) / length(down), 1, 1e-6) << "pixels are squares";
  EXPECT_NEAR(dot(forward, right), 0, 1e-6 * length(right));
  EXPECT_NEAR(dot(forward, down), 0, 1e-6 * length(right));
  EXPECT_NEAR(dot(right, down), 0, 1e-6 * length(right) * length(right));
}

void expect_numbers(const Frame& frame) {
  for (const auto& [name, value] : frame.all()) EXPECT_TRUE(std::isfinite(value)) << name << " is " << value;
}

TEST(FrameValues, of_a_perspective_camera) {
  const Frame frame("x\ncamera from (0, 0, 10) to (0, 0, 0) fov 90");
  expect_orthonormal(frame);
  expect_near(frame("eye"), {0, 0, 10});
  expect_near(frame("forward"), {0, 0, -1});
  expect_near(frame.at(0, 0), {-2, 1, -1});  // a quarter turn high, twice as wide
  expect_near(frame.at(40, 20), {2, -1, -1});
  expect_near(frame.at(20, 10), {0, 0, -1});
}

TEST(FrameValues, of_an_orthographic_camera) {
  const Frame frame("x\ncamera from (10, 0, 0) to (0, 0, 0) up (0, 0, 3) height 5");
  expect_orthonormal(frame);
  expect_near(frame("forward"), {-1, 0, 0});
  expect_near(frame.at(0, 0), {0, -5, 2.5});
  expect_near(frame.at(40, 20), {0, 5, -2.5});
}

TEST(FrameValues, of_a_camera_that_looks_along_up) {
  for (const char* camera :
       {"from (0, 5, 0) to (0, 0, 0)", "from (0, -5, 0) to (0, 0, 0)",
        "from (0, 0, 5) to (0, 0, 0) up (0, 0, 1)", "from (5, 5, 5) to (0, 0, 0) up (-1, -1, -1)",
        "from (5, 0, 0) to (0, 0, 0) up (0, 0, 0)", "from (1e-9, 5, 0) to (0, 0, 0)",
        "from (1e-13, 5, 0) to (0, 0, 0)"}) {
    SCOPED_TRACE(camera);
    const Frame frame(std::string("x\ncamera ") + camera + " fov 40");
    expect_orthonormal(frame);
    expect_numbers(frame);
  }
}

TEST(FrameValues, without_a_camera_show_the_whole_domain) {
  for (const char* domain :
       {"", "domain box((-1, 2, 3), (4, 5, 16))", "domain sphere(center: (7, 8, 9), radius: 0.5)"}) {
    SCOPED_TRACE(domain);
    const Frame frame(std::string("x\n") + domain);
    expect_orthonormal(frame);
    expect_numbers(frame);
  }
  const Frame frame("x\ndomain sphere(center: (7, 8, 9), radius: 0.5)", 10, 10);
  Triple to_center;
  for (std::size_t i = 0; i < 3; ++i) to_center[i] = std::array{7, 8, 9}[i] - frame("eye")[i];
  EXPECT_NEAR(dot(to_center, frame("forward")), length(to_center), 1e-5);
  EXPECT_NEAR(0.5 / length(to_center), std::sin(std::atan(5 * length(frame("down")))), 1e-6)
      << "it just fits";
}

TEST(FrameValues, hold_domain_and_lights) {
  const Frame box(
      "param a = 2\nx\ndomain box((-a, 0, 1), (a, a^2, 3))\nlight from (a, 1, 1) color (1, 0.5, a) intensity "
      "3");
  expect_near(box("domain.min"), {-2, 0, 1});
  expect_near(box("domain.max"), {2, 4, 3});
  expect_near(box("light0"), {2, 1, 1});
  expect_near(box("light0", "rgb"), {3, 1.5, 6});

  const Frame sphere("x\ndomain sphere(radius: 3)\nlight direction (0, -2, 0)");
  expect_near(sphere("domain.center"), {0, 0, 0});
  EXPECT_EQ(sphere.number("domain.radius"), 3);
  expect_near(sphere("light0"), {0, 1, 0});  // towards it

  expect_near(Frame("x")("domain.max"), {2, 2, 2});
}

TEST(SpaceBounds, where_the_domain_is_constant) {
  const auto of = [](const char* source) { return space_bounds(test::model_of(source)); };
  EXPECT_EQ(of("x").value()[1].hi, 2);
  EXPECT_EQ(of("x\ndomain box((-1, -2, -3), (1, 2, 3))").value()[2].lo, -3);
  EXPECT_EQ(of("x\ndomain sphere(center: (1, 0, 0), radius: 5)").value()[0].hi, 6);
  EXPECT_LT(of("x\ndomain sphere(radius: sqrt(3))").value()[0].lo, -std::sqrt(3.0)) << "outward";
  EXPECT_FALSE(of("param r = 2\nx\ndomain sphere(radius: r)"));
  EXPECT_FALSE(of("time w = 2\nx\ndomain box((0, 0, 0), (1, 1, w))"));
}

}  // namespace
}  // namespace imp
