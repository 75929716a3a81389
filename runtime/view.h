// The numbers of one frame: what a Model says of its camera, domain and lights, with defaults where
// it is silent, as the uniforms of a pixel's Program.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "frontend/model.h"
#include "runtime/numbers.h"
#include "runtime/search/segment.h"

namespace imp {

// What is silent: a box from -2 to 2; a camera that sees the whole domain from a little above; a
// light over each shoulder of the viewer.
inline constexpr double default_domain = 2;
inline constexpr std::size_t default_lights = 2;

bool is_orthographic(const Model& model);
bool has_sphere_domain(const Model& model);

// For each light whether it is directional, defaults included.
std::vector<bool> directional_lights(const Model& model);

// What makes a picture impossible, as errors at its place in the file: a camera that looks at where it
// is or sees no angle, a domain that is empty.
bool check_view(const Model& model, const UniformValues& uniforms, Diagnostics& diagnostics);

// A box around the domain, where it does not depend on parameters or time.
std::optional<SpaceBounds> space_bounds(const Model& model);

// The value of each frame input of the pixel's Program by name: eye.x, forward.x, …, domain.min.x
// or domain.center.x and domain.radius, light0.x, light0.r, …, and what beams need: depth.near, depth.far,
// pad.place, pad.way (runtime/beam.h).
std::map<std::string, float> frame_values(const Model& model, const Numbers& numbers, std::size_t width,
                                          std::size_t height);

// The same values and the uniforms, where the inputs of rate frame of a pixel's Program find them.
class FrameInputs {
 public:
  FrameInputs(const Model& model, UniformValues uniforms, std::size_t width, std::size_t height);
  const void* operator()(const Input& input) const;

 private:
  UniformValues uniforms_;
  std::unordered_map<std::string, std::size_t> places_;  // of the uniforms, by the name of the input
  std::map<std::string, float> values_;
};

}  // namespace imp
