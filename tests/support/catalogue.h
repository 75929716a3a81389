// The surfaces of tests/data and what a test does with them first: find them, read them.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/model.h"
#include "passes/precision.h"
#include "tests/support/evaluate.h"
#include "tests/support/surface_data.h"

namespace imp::test {

inline const std::vector<SurfaceEntry>& catalogue() {
  static const auto entries = load_surfaces(IMP_TEST_DATA);
  return entries;
}

inline const SurfaceEntry& entry_named(std::string_view id) {
  const auto it = std::ranges::find(catalogue(), id, &SurfaceEntry::id);
  if (it == catalogue().end()) throw std::runtime_error("no surface " + std::string(id));
  return *it;
}

inline std::vector<const SurfaceEntry*> all_entries() {
  std::vector<const SurfaceEntry*> result;
  for (const SurfaceEntry& entry : catalogue()) result.push_back(&entry);
  return result;
}

// The polynomials.
inline std::vector<const SurfaceEntry*> algebraic_entries() {
  std::vector<const SurfaceEntry*> result;
  for (const SurfaceEntry& entry : catalogue())
    if (entry.kind == "algebraic") result.push_back(&entry);
  return result;
}

// Throws where the text is wrong.
inline Model model_of(const std::string& source, const std::string& name = "test") {
  Diagnostics diagnostics;
  auto model = parse_model(source, name + ".imp", diagnostics);
  if (!model) throw std::runtime_error(to_text(diagnostics));
  return *std::move(model);
}
inline Model model_of(const SurfaceEntry& entry) { return model_of(entry.source, entry.id); }

// The inputs of a surface at a point: x, y, z, the parameters at their defaults, the time.
inline std::vector<double> inputs_at(const Model& model, const ValueRecord& record) {
  std::vector<double> values(record.p.begin(), record.p.end());
  const auto settings =
      evaluate(in_precision(model.settings, f64), std::vector<double>(model.settings.inputs.size()));
  for (const Parameter& parameter : model.parameters) values.push_back(settings[parameter.value.output]);
  if (model.time) values.push_back(record.time.value_or(settings[model.time->value.output]));
  return values;
}

}  // namespace imp::test
