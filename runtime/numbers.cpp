#include "runtime/numbers.h"

#include <fmt/format.h>

#include <algorithm>

#include "backends/interpreter/interpreter.h"
#include "passes/constants.h"
#include "passes/power.h"
#include "passes/precision.h"
#include "runtime/kernel.h"

namespace imp {
namespace {

std::vector<const Parameter*> uniforms_of(const Model& model) {
  std::vector<const Parameter*> result;
  for (const Parameter& parameter : model.parameters) result.push_back(&parameter);
  if (model.time) result.push_back(&*model.time);
  return result;
}

// Of a Setting that depends on nothing.
double constant(const Model& model, const std::vector<std::optional<Enclosure>>& values, Setting setting) {
  const auto& value = values[model.settings.outputs[setting.output].id.index];
  return value ? value->nearest : 0;
}

}  // namespace

std::vector<std::string> uniform_names(const Model& model) {
  std::vector<std::string> names;
  for (const Parameter* uniform : uniforms_of(model)) names.push_back(uniform->name);
  return names;
}

std::optional<UniformValues> uniform_values(const Model& model, std::span<const Override> overrides,
                                            std::optional<double> time, Diagnostics& diagnostics) {
  const auto uniforms = uniforms_of(model);
  const auto constants = constant_values(model.settings);
  UniformValues values;
  for (const Parameter* uniform : uniforms) values.push_back(constant(model, constants, uniform->value));

  const auto set = [&](std::size_t i, double value) {
    values[i] = value;
    const Parameter& uniform = *uniforms[i];
    if (!uniform.range) return;
    const double lo = constant(model, constants, (*uniform.range)[0]);
    const double hi = constant(model, constants, (*uniform.range)[1]);
    if (!(lo <= value && value <= hi))
      diagnostics.warning(uniform.span, fmt::format("{} is outside the range of '{}', [{}, {}]", value,
                                                    uniform.name, lo, hi));
  };

  const std::vector<std::string> names = uniform_names(model);
  for (const Override& change : overrides) {
    const auto it = std::ranges::find(names, change.name);
    if (it == names.end()) {
      const std::vector<std::string_view> known(names.begin(), names.end());
      std::string message = fmt::format("the file has no parameter '{}'", change.name);
      message += names.empty() ? "; 'param NAME = VALUE' would make one" : did_you_mean(change.name, known);
      diagnostics.error(message);
    } else {
      set(static_cast<std::size_t>(it - names.begin()), change.value);
    }
  }
  if (time) {
    if (model.time)
      set(values.size() - 1, *time);
    else
      diagnostics.error("the file has no time; 'time NAME = VALUE' would make it depend on one");
  }
  return diagnostics.has_errors() ? std::nullopt : std::optional(values);
}

Numbers::Numbers(const Model& model, const UniformValues& uniforms) {
  const auto kernel = interpret(reduce_powers(in_precision(model.settings, f64)));
  std::vector<Column> inputs;
  for (const double value : uniforms) inputs.push_back({value});
  for (const Column& column : run_rows(*kernel, inputs, 1)) values_.push_back(column[0]);
}

}  // namespace imp
