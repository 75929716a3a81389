// Cameras and domains as Programs: from a pixel to the piece of its ray inside the domain.
#pragma once

#include <array>

#include "ir/expr.h"
#include "ir/program.h"

namespace imp {

using Vector = std::array<Expr, 3>;

Expr dot(const Vector& a, const Vector& b);
Vector scaled(const Vector& a, Expr factor);
Vector sum(const Vector& a, const Vector& b);
Vector difference(const Vector& a, const Vector& b);
Vector normalized(const Vector& a);

struct PixelRay {
  Vector origin, direction;  // direction of length 1
  Expr length;               // the way to depth 1, as depth is measured along the camera's axis
};

// The numbers of a camera for one frame: uniforms of the kernel. To a pixel (i, j), counted from the
// upper left with centres at halves, belongs the offset  corner + i * right + j * down:  the
// direction from `eye` (perspective), or the way from `eye` to where a ray along `forward` begins.
struct CameraInputs {
  Vector eye, forward, corner, right, down;
};
CameraInputs camera_inputs(Program& program);

PixelRay perspective_ray(const CameraInputs& camera, Expr i, Expr j);
PixelRay orthographic_ray(const CameraInputs& camera, Expr i, Expr j);

// The piece of a ray, with t >= 0, within a domain; near >= far where there is none.
struct Clip {
  Expr near, far;
};
Clip clip_to_box(const PixelRay& ray, const Vector& min, const Vector& max);
Clip clip_to_sphere(const PixelRay& ray, const Vector& center, Expr radius);

}  // namespace imp
