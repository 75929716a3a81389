// The surfaces of tests/data and what a test does with them first: find them, read them.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/model.h"
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

}  // namespace imp::test
