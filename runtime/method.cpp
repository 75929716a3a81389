#include "runtime/method.h"

#include <fmt/format.h>

#include "ir/assert.h"
#include "passes/polynomial/degree.h"

namespace imp {
namespace {

bool is_polynomial(const Program& f) {
  constexpr std::size_t variables[] = {0, 1, 2};
  Diagnostics unused;
  return degrees(f, variables, unused).has_value();
}

}  // namespace

Method choose_method(const Program& f, const Wish& wish, const KernelOptions& kernel) {
  Method method{wish.search, wish.inclusion, !wish.search && kernel.precision == f32, {}};
  if (!method.search) {
    method.search = search_named("isolate");
    method.reason = "where df/ds excludes 0, signs at two ends decide";
  }
  if (!method.inclusion) {
    const bool too_long = kernel.backend == Backend::glsl && !is_polynomial(f);
    method.inclusion = inclusion_named(too_long ? "ia" : "auto");
    if (too_long) method.reason += "; intervals, as affine forms of such a formula make a shader too long";
  }
  IMP_ASSERT(method.search && method.inclusion, "rows of the tables");
  return method;
}

std::string to_text(const Method& method) {
  const std::string text =
      fmt::format("search {}, inclusion {}", method.search->name, method.inclusion->name);
  return method.reason.empty() ? text : fmt::format("{} (auto: {})", text, method.reason);
}

}  // namespace imp
