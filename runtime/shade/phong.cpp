#include "runtime/shade/phong.h"

#include <string>

namespace imp {
namespace {

// x^n for a power of two n, by squaring.
Expr sharpened(Expr x, double n) {
  for (double power = 1; power < n; power *= 2) x = x * x;
  return x;
}

}  // namespace

LightInputs light_inputs(Program& program, std::size_t index, bool directional) {
  LightInputs light{directional, {}, {}};
  const std::string name = "light" + std::to_string(index);
  const auto input = [&](const std::string& part) {
    return Expr{&program.graph, add_input(program, name + part, f32, Rate::frame)};
  };
  for (std::size_t i = 0; i < 3; ++i) light.place[i] = input(std::string(".") + "xyz"[i]);
  for (std::size_t i = 0; i < 3; ++i) light.color[i] = input(std::string(".") + "rgb"[i]);
  return light;
}

Color phong(const Material& material, std::span<const LightInputs> lights, const Vector& place,
            const Vector& normal, const Vector& view) {
  const Expr facing = dot(normal, view);
  const Truth outside = facing <= 0;
  const Expr turn = select(outside, one(facing), -one(facing));
  const Vector n = scaled(normal, turn);
  const Expr mirror = 2.0 * dot(view, n);
  const Vector reflected = difference(view, scaled(n, mirror));

  Color color;
  for (std::size_t i = 0; i < 3; ++i)
    color[i] = select(outside, constant_like(facing, material.ambient * material.front[i]),
                      constant_like(facing, material.ambient * material.back[i]));
  for (const LightInputs& light : lights) {
    const Vector towards = light.directional ? light.place : normalized(difference(light.place, place));
    const Expr diffuse = max(dot(n, towards), zero(facing));
    const Expr highlight =
        material.specular * sharpened(max(dot(reflected, towards), zero(facing)), material.shininess);
    for (std::size_t i = 0; i < 3; ++i) {
      const Expr body =
          select(outside, constant_like(facing, material.front[i]), constant_like(facing, material.back[i]));
      color[i] = color[i] + light.color[i] * (body * diffuse + highlight);
    }
  }
  return color;
}

}  // namespace imp
