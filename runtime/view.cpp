#include "runtime/view.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>

#include "passes/constants.h"

namespace imp {
namespace {

using glm::dvec3;

dvec3 vector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

// The sphere around the domain.
struct Surroundings {
  dvec3 center;
  double radius;
};

Surroundings surroundings(const Model& model, const Numbers& numbers) {
  if (!model.domain) return {dvec3(0), default_domain};  // tight: few know their domain yet
  if (const auto* sphere = std::get_if<Sphere>(&*model.domain))
    return {vector(numbers(sphere->center)), numbers(sphere->radius)};
  const auto& box = std::get<Box>(*model.domain);
  const dvec3 lo = vector(numbers(box.min)), hi = vector(numbers(box.max));
  return {0.5 * (lo + hi), 0.4 * glm::length(hi - lo)};  // the corners are seldom of interest
}

// An orthonormal frame: where the camera is, looks, and what is right and down in the picture.
struct Frame {
  dvec3 eye, forward, right, down;
  double half_height;  // of the picture: at distance 1 (perspective), or in lengths
};

constexpr double default_fov = 30;  // degrees

dvec3 any_normal_to(const dvec3& v) {
  return glm::normalize(glm::cross(v, std::abs(v.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
}

Frame camera_frame(const Model& model, const Numbers& numbers) {
  const Surroundings around = surroundings(model, numbers);
  const double distance = around.radius / std::sin(glm::radians(default_fov / 2));
  dvec3 eye = around.center + distance * glm::normalize(dvec3(0.55, 0.4, 0.75));
  dvec3 to = around.center, up(0, 1, 0);
  double half_height = std::tan(glm::radians(default_fov / 2));
  if (model.camera) {
    const Camera& camera = *model.camera;
    eye = vector(numbers(camera.from));
    to = vector(numbers(camera.to));
    up = vector(numbers(camera.up));
    half_height =
        camera.height ? numbers(*camera.height) / 2 : std::tan(glm::radians(numbers(*camera.fov) / 2));
  }
  const dvec3 forward = glm::normalize(to - eye);
  const dvec3 across = glm::cross(forward, up);
  const bool looks_along_up = !(glm::length(across) > 1e-9 * glm::length(up));
  const dvec3 right = looks_along_up ? any_normal_to(forward) : glm::normalize(across);
  return {eye, forward, right, glm::cross(forward, right), half_height};
}

class FrameValues {
 public:
  void set(const std::string& name, const dvec3& v, const char* parts = "xyz") {
    for (int i = 0; i < 3; ++i) set(name + "." + parts[i], v[i]);
  }
  void set(const std::string& name, double value) { values[name] = static_cast<float>(value); }

  std::map<std::string, float> values;
};

void set_light(FrameValues& values, std::size_t index, const dvec3& place, const dvec3& color) {
  const std::string name = "light" + std::to_string(index);
  values.set(name, place);
  values.set(name, color, "rgb");
}

void set_lights(FrameValues& values, const Model& model, const Numbers& numbers, const Frame& frame) {
  if (model.lights.empty()) {
    const auto towards = [&](double right, double up) {
      return glm::normalize(right * frame.right - up * frame.down - frame.forward);
    };
    set_light(values, 0, towards(-0.6, 0.8), dvec3(0.85));
    set_light(values, 1, towards(0.9, -0.1), dvec3(0.25));
  }
  for (std::size_t i = 0; i < model.lights.size(); ++i) {
    const Light& light = model.lights[i];
    const dvec3 place = vector(numbers(light.place));
    set_light(values, i, light.directional ? -glm::normalize(place) : place,
              numbers(light.intensity) * vector(numbers(light.color)));
  }
}

void set_domain(FrameValues& values, const Model& model, const Numbers& numbers) {
  if (!model.domain) {
    values.set("domain.min", dvec3(-default_domain));
    values.set("domain.max", dvec3(default_domain));
  } else if (const auto* box = std::get_if<Box>(&*model.domain)) {
    values.set("domain.min", vector(numbers(box->min)));
    values.set("domain.max", vector(numbers(box->max)));
  } else {
    const auto& sphere = std::get<Sphere>(*model.domain);
    values.set("domain.center", vector(numbers(sphere.center)));
    values.set("domain.radius", numbers(sphere.radius));
  }
}

// Where the domain lies, as depths along the axis of the camera: none of it is nearer or farther.
Range depths(const Model& model, const Numbers& numbers, const Frame& frame) {
  const auto depth = [&](const dvec3& place) { return glm::dot(place - frame.eye, frame.forward); };
  if (has_sphere_domain(model)) {
    const auto& sphere = std::get<Sphere>(*model.domain);
    const double middle = depth(vector(numbers(sphere.center))), radius = numbers(sphere.radius);
    return {middle - radius, middle + radius};
  }
  dvec3 lo(-default_domain), hi(default_domain);
  if (model.domain) {
    lo = vector(numbers(std::get<Box>(*model.domain).min));
    hi = vector(numbers(std::get<Box>(*model.domain).max));
  }
  Range range{everything.hi, everything.lo};
  for (int corner = 0; corner < 8; ++corner) {
    const double d = depth({corner & 1 ? hi.x : lo.x, corner & 2 ? hi.y : lo.y, corner & 4 ? hi.z : lo.z});
    range = {std::min(range.lo, d), std::max(range.hi, d)};
  }
  return range;
}

// What the beams need (runtime/beam.h): the depths of the domain, and how far the rays that a kernel
// computes in floats may be from the exact ones. A direction takes a dozen roundings and a place a dozen
// more, each off by at most 2^-23 of the largest number on the way: 2^-18 is more than all of them.
void set_beams(FrameValues& values, const Model& model, const Numbers& numbers, const Frame& frame,
               double longest_way) {
  constexpr double share = 0x1p-18;
  const Range range = depths(model, numbers, frame);
  const double place =
      glm::length(frame.eye) + (1 + std::max(std::abs(range.lo), std::abs(range.hi))) * longest_way;
  values.set("depth.near", std::max(range.lo - share * place, 0.0));
  values.set("depth.far", range.hi + share * place);
  values.set("pad.place", share * place);
  values.set("pad.way", share * longest_way);
}

}  // namespace

bool check_view(const Model& model, const UniformValues& uniforms, Diagnostics& diagnostics) {
  const Numbers numbers(model, uniforms);
  const auto demand = [&](bool holds, Setting culprit, const char* message) {
    if (!holds) diagnostics.error(culprit.span, message);
    return holds;
  };
  // Squares of them are floats.
  const auto within_floats = [&](const std::array<Setting, 3>& place) {
    for (const Setting& coordinate : place)
      demand(std::abs(numbers(coordinate)) <= 1e18, coordinate, "in a picture no coordinate is beyond 1e18");
  };
  if (model.camera) {
    const Camera& camera = *model.camera;
    within_floats(camera.from);
    within_floats(camera.to);
    const auto [from, to] = std::pair(vector(numbers(camera.from)), vector(numbers(camera.to)));
    demand(glm::length(to - from) > 0, camera.to[0], "the camera looks at the very point where it is");
    if (camera.fov)
      demand(numbers(*camera.fov) > 0 && numbers(*camera.fov) < 180, *camera.fov,
             "a field of view lies between 0 and 180 degrees");
    if (camera.height) demand(numbers(*camera.height) > 0, *camera.height, "a height is above 0");
  }
  if (model.domain) {
    if (const auto* box = std::get_if<Box>(&*model.domain)) {
      within_floats(box->min);
      within_floats(box->max);
      bool open = true;
      for (std::size_t i = 0; i < 3 && open; ++i)
        open = demand(numbers(box->min[i]) < numbers(box->max[i]), box->max[i],
                      "the domain is empty: this coordinate is not above that of the other corner");
    } else {
      const Sphere& sphere = std::get<Sphere>(*model.domain);
      within_floats(sphere.center);
      demand(numbers(sphere.radius) > 0, sphere.radius, "the domain is empty: its radius is not above 0");
      demand(!(numbers(sphere.radius) > 1e18), sphere.radius, "in a picture no radius is beyond 1e18");
    }
  }
  return !diagnostics.has_errors();
}

bool is_orthographic(const Model& model) { return model.camera && model.camera->height.has_value(); }

bool has_sphere_domain(const Model& model) {
  return model.domain && std::holds_alternative<Sphere>(*model.domain);
}

std::vector<bool> directional_lights(const Model& model) {
  if (model.lights.empty()) return std::vector<bool>(default_lights, true);
  std::vector<bool> result;
  for (const Light& light : model.lights) result.push_back(light.directional);
  return result;
}

std::optional<SpaceBounds> space_bounds(const Model& model) {
  if (!model.domain) {
    const Range side{-default_domain, default_domain};
    return SpaceBounds{side, side, side};
  }
  const auto constants = constant_values(model.settings);
  const auto range = [&](Setting setting) -> std::optional<Range> {
    const auto& value = constants[model.settings.outputs[setting.output].id.index];
    return value && value->lo <= value->hi ? std::optional(Range{value->lo, value->hi}) : std::nullopt;
  };
  SpaceBounds bounds{everything, everything, everything};
  for (std::size_t i = 0; i < 3; ++i) {
    if (const auto* box = std::get_if<Box>(&*model.domain)) {
      const auto lo = range(box->min[i]), hi = range(box->max[i]);
      if (!lo || !hi) return std::nullopt;
      bounds[i] = {lo->lo, hi->hi};
    } else {
      const auto& sphere = std::get<Sphere>(*model.domain);
      const auto center = range(sphere.center[i]), radius = range(sphere.radius);
      if (!center || !radius) return std::nullopt;
      bounds[i] = {center->lo - radius->hi, center->hi + radius->hi};
    }
  }
  return bounds;
}

std::map<std::string, float> frame_values(const Model& model, const Numbers& numbers, std::size_t width,
                                          std::size_t height) {
  const Frame frame = camera_frame(model, numbers);
  const double pixel = 2 * frame.half_height / static_cast<double>(height);
  const dvec3 right = pixel * frame.right, down = pixel * frame.down;
  dvec3 corner = -0.5 * static_cast<double>(width) * right - 0.5 * static_cast<double>(height) * down;
  if (!is_orthographic(model)) corner += frame.forward;

  FrameValues values;
  values.set("eye", frame.eye);
  values.set("forward", frame.forward);
  values.set("corner", corner);
  values.set("right", right);
  values.set("down", down);
  set_domain(values, model, numbers);
  set_lights(values, model, numbers, frame);
  set_beams(values, model, numbers, frame,
            1 + glm::length(corner) + static_cast<double>(width) * glm::length(right) +
                static_cast<double>(height) * glm::length(down));
  return values.values;
}

FrameInputs::FrameInputs(const Model& model, UniformValues uniforms, std::size_t width, std::size_t height)
    : uniforms_(std::move(uniforms)), values_(frame_values(model, Numbers(model, uniforms_), width, height)) {
  for (const std::string& name : uniform_names(model))
    places_.try_emplace(uniform_input(name), places_.size());
}

const void* FrameInputs::operator()(const Input& input) const {
  if (input.type == f32) return &values_.at(input.name);
  return &uniforms_[places_.at(input.name)];
}

}  // namespace imp
