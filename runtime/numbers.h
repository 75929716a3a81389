// The numbers of a Model for given parameters: its domain, camera and lights.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "frontend/model.h"

namespace imp {

// A value for every parameter in the order of the file, then for the time if there is one: the
// order of the uniforms of every surface.
using UniformValues = std::vector<double>;

struct Override {  // -D name=value
  std::string name;
  double value;
};

// The defaults with overrides. Errors name an unknown parameter; a value outside the range that the
// file gives is a warning.
std::optional<UniformValues> uniform_values(const Model& model, std::span<const Override> overrides,
                                            std::optional<double> time, Diagnostics& diagnostics);

// Names of the uniforms in that order.
std::vector<std::string> uniform_names(const Model& model);

// What a uniform is called as an input of a kernel that has inputs of its own.
inline std::string uniform_input(const std::string& name) { return "parameter." + name; }

// Every Setting's value, by Setting::output.
class Numbers {
 public:
  Numbers(const Model& model, const UniformValues& uniforms);
  double operator()(Setting setting) const { return values_[setting.output]; }
  std::array<double, 3> operator()(const Point& p) const {
    return {(*this)(p[0]), (*this)(p[1]), (*this)(p[2])};
  }

 private:
  std::vector<double> values_;
};

}  // namespace imp
