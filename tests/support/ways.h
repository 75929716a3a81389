// The ways there are to search: every strategy with some inclusions, in both precisions. A test that runs over
// them covers a new strategy by its row in searches(). As most of such a test is making kernels, it takes a part
// of them: every strategy in float, and in double the one that `auto` takes (under sanitizers that one, in float
// only); all where IMP_EVERY_WAY is set, as by `tools/dev prove scenes`.
#pragma once

#include <cstdlib>
#include <expected>
#include <string>
#include <vector>

#include "tests/support/cast.h"
#include "tests/support/effort.h"

namespace imp::test {

struct Way {
  const Search* search;
  const Inclusion* inclusion;
  Type precision;

  std::string name() const {
    return std::string(search->name) + ", " + std::string(inclusion->name) + ", " + to_text(precision);
  }
};

inline bool is_of_auto(const Way& way) {
  return way.search->name == "isolate" && way.inclusion->name == "auto";
}

inline std::vector<Way> every_way(std::initializer_list<std::string_view> inclusions_by_name) {
  std::vector<Way> result;
  for (const Search& search : searches())
    for (const std::string_view name : inclusions_by_name)
      for (const Type precision : {f32, f64}) {
        const Inclusion* inclusion = inclusion_named(name);
        if (!inclusion) throw std::runtime_error("no inclusion " + std::string(name));
        result.push_back({&search, inclusion, precision});
      }
  return result;
}

inline std::vector<Way> ways(std::initializer_list<std::string_view> inclusions_by_name = {"auto"}) {
  std::vector<Way> result = every_way(inclusions_by_name);
  if (std::getenv("IMP_EVERY_WAY") == nullptr)
    std::erase_if(result, [](const Way& way) {
      const bool wide = way.precision == f64;
      return way.inclusion->name != "auto" ||
             (sanitized ? wide || !is_of_auto(way) : wide && !is_of_auto(way));
    });
  return result;
}

// Casts rays at the first surface of `model`; or the reason why this way refuses it.
inline std::expected<Caster, std::string> caster(const Model& model, const Way& way,
                                                 Backend backend = Backend::llvm,
                                                 const std::vector<Override>& overrides = {}) {
  try {
    return Caster(model, {.backend = backend, .precision = way.precision}, {}, overrides, *way.inclusion,
                  *way.search);
  } catch (const std::runtime_error& refusal) { return std::unexpected(refusal.what()); }
}

}  // namespace imp::test
