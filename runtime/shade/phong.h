// Phong's illumination (Phong 1975) of a point on a surface, in linear light.
#pragma once

#include <span>

#include "runtime/camera.h"

namespace imp {

using Color = std::array<Expr, 3>;

// The numbers of a light for one frame: uniforms of the kernel.
struct LightInputs {
  bool directional;
  Vector place;  // a point, or the unit vector towards a directional light
  Color color;   // times the intensity
};
LightInputs light_inputs(Program& program, std::size_t index, bool directional);

struct Material {
  std::array<double, 3> front, back;  // outside (f > 0) and inside
  double ambient = 0.12, specular = 0.35, shininess = 40;
};

// `normal` is the unit gradient of f; the side that is seen is lit.
Color phong(const Material& material, std::span<const LightInputs> lights, const Vector& place,
            const Vector& normal, const Vector& view);

}  // namespace imp
