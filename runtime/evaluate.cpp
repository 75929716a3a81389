#include "runtime/evaluate.h"

#include <limits>

#include "passes/differentiate.h"
#include "passes/extend/interval.h"
#include "passes/inline.h"
#include "passes/precision.h"
#include "runtime/camera.h"
#include "runtime/numbers.h"
#include "runtime/search/segment.h"

namespace imp {
namespace {

Expr to(Type type, Expr wide) { return type == f32 ? narrow(wide) : wide; }
Expr from(Type type, Expr value) { return type == f32 ? widen(value) : value; }

// `program` (f64, constants unresolved) computed in `type`, between inputs and outputs in f64.
Program at_points(const Program& program, Type type) {
  const Program inner = in_precision(program, type);
  Program result{.name = program.name};
  std::vector<Expr> inputs;
  for (const Input& input : program.inputs)
    inputs.push_back(to(type, {&result.graph, add_input(result, input.name, f64, Rate::ray)}));
  const auto values = inline_program(inner, inputs);
  for (std::size_t i = 0; i < values.size(); ++i)
    result.outputs.push_back({program.outputs[i].name, from(type, values[i]).id});
  return result;
}

// Uniforms that change from row to row.
Program with_ray_inputs(Program program) {
  for (Input& input : program.inputs) input.rate = Rate::ray;
  return program;
}

}  // namespace

std::optional<Evaluation> evaluation_named(std::string_view name) {
  if (name == "f") return Evaluation::f;
  if (name == "gradient") return Evaluation::gradient;
  if (name == "hessian") return Evaluation::hessian;
  if (name == "interval") return Evaluation::interval;
  return std::nullopt;
}

std::optional<Program> evaluation_program(const Surface& surface, Evaluation evaluation, Type precision,
                                          Diagnostics& diagnostics) {
  std::optional<Program> program;
  switch (evaluation) {
    case Evaluation::f:        return at_points(surface.f, precision);
    case Evaluation::gradient: program = gradient(surface.f, diagnostics); break;
    case Evaluation::hessian:  program = hessian(surface.f, diagnostics); break;
    case Evaluation::interval: return interval_extension(with_ray_inputs(surface.f), precision, diagnostics);
  }
  if (!program) return std::nullopt;
  return at_points(*program, precision);
}

std::optional<Program> cast_program(const Surface& surface, const Search& search, const SearchLimits& limits,
                                    Type precision, Diagnostics& diagnostics) {
  const auto gradient_of_f = gradient(surface.f, diagnostics);
  if (!gradient_of_f) return std::nullopt;

  Program result{.name = surface.name};
  const auto input = [&](const std::string& name) {
    return Expr{&result.graph, add_input(result, name, f64, Rate::ray)};
  };
  const Vector o{input("ox"), input("oy"), input("oz")};
  const Vector d{input("dx"), input("dy"), input("dz")};
  const Expr tmin = input("tmin"), tmax = input("tmax");
  std::vector<Uniform> uniforms;
  for (std::size_t i = 3; i < surface.f.inputs.size(); ++i)
    uniforms.push_back(uniform(input(uniform_input(surface.f.inputs[i].name)), precision));

  const Segment segment = segment_of_ray(o, d, tmin, tmax, precision);
  const auto f = ray_function(surface.f, segment, uniforms, std::nullopt, diagnostics);
  if (!f) return std::nullopt;
  const Found found = search.build(result, *f, limits);

  std::vector<Expr> place;
  for (std::size_t i = 0; i < 3; ++i) place.push_back(segment.origin[i] + found.s * segment.direction[i]);
  for (const Uniform& each : uniforms) place.push_back(each.value);
  const auto values = inline_program(in_precision(*gradient_of_f, precision), place);
  const Vector normal = normalized({values[1], values[2], values[3]});

  const Expr nothing = constant_like(tmin, std::numeric_limits<double>::quiet_NaN());
  const auto output = [&](const char* name, Expr value) { result.outputs.push_back({name, value.id}); };
  const auto where_found = [&](Expr value) { return select(found.something, value, nothing); };
  output("verdict", from(precision, found.verdict));
  output("t", where_found(tmin + from(precision, found.s) * (tmax - tmin)));
  output("nx", where_found(from(precision, normal[0])));
  output("ny", where_found(from(precision, normal[1])));
  output("nz", where_found(from(precision, normal[2])));
  output("steps", from(precision, found.steps));
  return result;
}

}  // namespace imp
