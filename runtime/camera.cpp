#include "runtime/camera.h"

#include <string>

#include "ir/infinity.h"

namespace imp {
namespace {

Vector vector_input(Program& program, const std::string& name) {
  Vector v;
  for (std::size_t i = 0; i < 3; ++i)
    v[i] = {&program.graph, add_input(program, name + "." + "xyz"[i], f32, Rate::frame)};
  return v;
}

Vector offset(const CameraInputs& camera, Expr i, Expr j) {
  return sum(camera.corner, sum(scaled(camera.right, i), scaled(camera.down, j)));
}

}  // namespace

Expr dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector scaled(const Vector& a, Expr factor) { return {a[0] * factor, a[1] * factor, a[2] * factor}; }
Vector sum(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vector difference(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector normalized(const Vector& a) {
  const Expr length = sqrt(dot(a, a));
  return {a[0] / length, a[1] / length, a[2] / length};
}

CameraInputs camera_inputs(Program& program) {
  return {vector_input(program, "eye"), vector_input(program, "forward"), vector_input(program, "corner"),
          vector_input(program, "right"), vector_input(program, "down")};
}

PixelRay perspective_ray(const CameraInputs& camera, Expr i, Expr j) {
  const Vector way = offset(camera, i, j);
  const Expr length = sqrt(dot(way, way));
  return {camera.eye, {way[0] / length, way[1] / length, way[2] / length}, length};
}

PixelRay orthographic_ray(const CameraInputs& camera, Expr i, Expr j) {
  return {sum(camera.eye, offset(camera, i, j)), camera.forward, one(i)};
}

// Slabs; a ray parallel to one is inside it for ever or never.
Clip clip_to_box(const PixelRay& ray, const Vector& lo, const Vector& hi) {
  Clip clip{zero(ray.origin[0]), constant_like(ray.origin[0], infinity)};
  for (std::size_t i = 0; i < 3; ++i) {
    const Expr o = ray.origin[i], d = ray.direction[i];
    const Truth parallel = equal(d, zero(d)), within = lo[i] <= o && o <= hi[i];
    const Expr always = constant_like(d, -infinity), never = constant_like(d, infinity);
    const Expr enter = (lo[i] - o) / d, leave = (hi[i] - o) / d;
    clip.near = max(clip.near, select(parallel, select(within, always, never), min(enter, leave)));
    clip.far = min(clip.far, select(parallel, never, max(enter, leave)));
  }
  return clip;
}

Clip clip_to_sphere(const PixelRay& ray, const Vector& center, Expr radius) {
  const Vector from_center = difference(ray.origin, center);
  const Expr b = dot(from_center, ray.direction);
  const Vector closest = difference(from_center, scaled(ray.direction, b));
  const Expr square = radius * radius - dot(closest, closest);
  const Expr half = select(square < 0, -one(b), sqrt(square));  // below 0: no piece
  return {max(-b - half, zero(b)), half - b};
}

}  // namespace imp
