#include "runtime/evaluate.h"

#include <algorithm>
#include <limits>

#include "passes/differentiate.h"
#include "passes/extend/forms.h"
#include "passes/inline.h"
#include "passes/precision.h"
#include "passes/surface_passes.h"
#include "runtime/camera.h"
#include "runtime/numbers.h"
#include "runtime/search/parts/refine.h"
#include "runtime/search/segment.h"

namespace imp {
namespace {

// `program` (f64, constants unresolved) computed in `type`, between inputs and outputs in f64.
Program at_points(const Program& program, Type type) {
  const Program inner = in_precision(program, type);
  Program result{.name = program.name};
  std::vector<Expr> inputs;
  for (const Input& input : program.inputs)
    inputs.push_back(to(type, {&result.graph, add_input(result, input.name, f64, Rate::ray)}));
  const auto values = inline_program(inner, inputs);
  for (std::size_t i = 0; i < values.size(); ++i)
    result.outputs.push_back({program.outputs[i].name, to(f64, values[i]).id});
  return result;
}

// Uniforms that change from row to row.
Program with_ray_inputs(Program program) {
  for (Input& input : program.inputs) input.rate = Rate::ray;
  return program;
}

std::optional<Program> value(const Program& f, Diagnostics& /*diagnostics*/) { return f; }

// In the order of Evaluation.
struct Row {
  std::string_view name;
  std::optional<Program> (*derive)(const Program& f, Diagnostics& diagnostics);  // of points
  Form* form;                                                                    // of boxes
};

constexpr Row evaluations[] = {
    {"f", value, nullptr},
    {"gradient", gradient, nullptr},
    {"hessian", hessian, nullptr},
    {"interval", nullptr, interval_form},
    {"affine", nullptr, affine_form},
    {"taylor", nullptr, taylor_form},
    {"mean-value", nullptr, mean_value_form},
};

const Row& row(Evaluation evaluation) { return evaluations[static_cast<std::size_t>(evaluation)]; }

}  // namespace

std::optional<Evaluation> evaluation_named(std::string_view name) {
  const auto* it = std::ranges::find(evaluations, name, &Row::name);
  if (it == std::end(evaluations)) return std::nullopt;
  return static_cast<Evaluation>(it - std::begin(evaluations));
}

bool over_boxes(Evaluation evaluation) { return row(evaluation).form != nullptr; }

std::optional<Program> evaluation_program(const Surface& surface, Evaluation evaluation, Type precision,
                                          Diagnostics& diagnostics, const Inclusion* inclusion) {
  const Row& chosen = row(evaluation);
  const Program f = simplified(surface.f);
  Form* const form = inclusion && evaluation == Evaluation::interval ? inclusion->enclose : chosen.form;
  const auto program = form ? extension(f, *form, precision, diagnostics) : chosen.derive(f, diagnostics);
  if (!program) return std::nullopt;
  return form ? with_ray_inputs(*program) : at_points(*program, precision);
}

std::optional<Program> cast_program(const Surface& surface, const Search& search, const Inclusion& inclusion,
                                    const SearchLimits& limits, Type precision, Diagnostics& diagnostics) {
  const Program simple = simplified(surface.f);

  Program result{.name = surface.name};
  const auto input = [&](const std::string& name) {
    return Expr{&result.graph, add_input(result, name, f64, Rate::ray)};
  };
  const Vector o{input("ox"), input("oy"), input("oz")};
  const Vector d{input("dx"), input("dy"), input("dz")};
  const Expr tmin = input("tmin"), tmax = input("tmax");
  std::vector<Uniform> uniforms;
  for (std::size_t i = 3; i < simple.inputs.size(); ++i)
    uniforms.push_back(uniform(input(uniform_input(simple.inputs[i].name)), precision));

  const Segment segment = segment_of_ray(o, d, tmin, tmax, precision);
  const auto f = ray_function(simple, segment, uniforms, inclusion, std::nullopt, diagnostics);
  if (!f) return std::nullopt;
  const auto found = search.build(result, *f, limits, diagnostics);
  if (!found) return std::nullopt;

  const Refined root = refine(result, *f, found->bracket);
  const Expr s = root.s;
  const auto normal = normal_at(simple, segment, uniforms, s, diagnostics);
  if (!normal) return std::nullopt;

  const Expr nothing = constant_like(tmin, std::numeric_limits<double>::quiet_NaN());
  const auto output = [&](const char* name, Expr value) { result.outputs.push_back({name, value.id}); };
  const auto where_found = [&](Expr value) { return select(found->something, value, nothing); };
  output("verdict", to(f64, verdict_with(root, found->verdict)));
  output("t", where_found(tmin + to(f64, s) * (tmax - tmin)));
  output("nx", where_found(to(f64, (*normal)[0])));
  output("ny", where_found(to(f64, (*normal)[1])));
  output("nz", where_found(to(f64, (*normal)[2])));
  output("steps", to(f64, found->steps));
  return result;
}

}  // namespace imp
