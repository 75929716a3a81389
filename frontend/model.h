// What a .imp file says, checked and lowered: surfaces as Programs, everything else as numbers.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "ir/diagnostics.h"
#include "ir/program.h"

namespace imp {

// A number of the file outside the surfaces: an output of Model::settings, so that it may depend on
// parameters and time.
struct Setting {
  std::uint32_t output = 0;
  Span span{};  // where the file says it; invalid for a default
};
using Point = std::array<Setting, 3>;

// A uniform: changing it never recompiles.
struct Parameter {
  std::string name;
  Setting value;  // the default: constant, like the range
  std::optional<std::array<Setting, 2>> range;
  Span span;
};

// The zero set of f, whose inputs are x, y, z (rate ray), then every parameter in the order of the
// file, then the time (rate frame), all f64; its only output is f. Constants stand as the author
// wrote them: 0.1 is 1/10, sqrt(5) is an op, so that enclosures of them can be made.
struct Surface {
  std::string name;  // "surface" where the file gives none
  Program f;
  Span span;
};

struct Box {
  Point min, max;
};
struct Sphere {
  Point center;
  Setting radius;
};
using Domain = std::variant<Box, Sphere>;

struct Camera {
  Point from, to, up;
  std::optional<Setting> fov;     // degrees, vertical; perspective
  std::optional<Setting> height;  // of the picture, in the file's lengths; orthographic
};

struct Light {
  bool directional = false;
  Point place;  // where it is, or the direction it shines in
  Point color;
  Setting intensity;
};

struct Model {
  std::vector<Parameter> parameters;
  std::optional<Parameter> time;
  std::vector<Surface> surfaces;  // at least one
  std::optional<Domain> domain;
  std::optional<Camera> camera;
  std::vector<Light> lights;
  Program settings;  // inputs: parameters and time as in a surface; one output a Setting, f64
};

// Reads a file. On errors, which are in `diagnostics`, nothing; warnings leave a Model. Answers any
// input: text that nests or expands beyond a limit is an error at the place.
std::optional<Model> parse_model(std::string text, std::string name, Diagnostics& diagnostics);

}  // namespace imp
