#include "passes/along_ray.h"

#include "ir/assert.h"
#include "passes/inline.h"

namespace imp {

Program along_ray(const Program& f) {
  IMP_ASSERT(f.inputs.size() >= 3 && f.inputs[2].name == "z", "inputs x, y, z");
  Program result{.name = f.name};
  const auto input = [&](const std::string& name, Rate rate) {
    return Expr{&result.graph, add_input(result, name, f64, rate)};
  };
  const Expr s = input("s", Rate::ray);
  std::vector<Expr> origin, direction, place;
  for (const char* name : {"ox", "oy", "oz"}) origin.push_back(input(name, Rate::ray));
  for (const char* name : {"dx", "dy", "dz"}) direction.push_back(input(name, Rate::ray));
  for (std::size_t i = 0; i < 3; ++i) {
    place.push_back(origin[i] + s * direction[i]);
    result.graph.set_name(place[i].id, f.inputs[i].name);
  }
  for (std::size_t i = 3; i < f.inputs.size(); ++i)
    place.push_back(input(f.inputs[i].name, f.inputs[i].rate));

  const auto values = inline_program(f, place);
  for (std::size_t i = 0; i < values.size(); ++i) result.outputs.push_back({f.outputs[i].name, values[i].id});
  return result;
}

}  // namespace imp
