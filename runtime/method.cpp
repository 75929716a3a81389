#include "runtime/method.h"

#include <fmt/format.h>

#include "ir/assert.h"
#include "passes/polynomial/degree.h"
#include "passes/rewrite.h"

namespace imp {
namespace {

// Where the coefficients along a ray cost more than they tell.
constexpr std::uint32_t highest_degree = 12;
constexpr double operations_for_a_degree = 1.5;  // of f, for each degree

constexpr double most_in_a_shader = 30;  // operations of f, for any form but intervals

// The total degree of a polynomial.
std::optional<std::uint32_t> degree(const Program& f) {
  constexpr std::size_t variables[] = {0, 1, 2};
  Diagnostics unused;
  const auto all = degrees(f, variables, unused);
  if (!all) return std::nullopt;
  return all->front().total;
}

// Of f at a point; a Chebyshev polynomial takes about as many as its degree.
double operations(const Program& f) {
  const std::vector<bool> live = live_nodes(f);
  double count = 0;
  for (std::uint32_t i = 0; i < live.size(); ++i) {
    const Node node = f.graph[Id{i}];
    if (!live[i] || node.args.empty()) continue;
    count += node.op == Op::chebyshev ? f.graph.number(node.args[1]).value_or(1) : 1;
  }
  return count;
}

void choose_search(Method& method, const Program& f, const KernelOptions& kernel) {
  method.search = search_named("isolate");
  method.reason = "where df/ds excludes 0, signs at two ends decide";
  const auto n = degree(f);
  if (!n || kernel.backend == Backend::glsl || kernel.precision == f64) return;
  const double count = operations(f);
  const std::string found = fmt::format("degree {}, {} operations: ", *n, count);
  if (*n <= highest_degree && count >= operations_for_a_degree * *n) {
    method.search = search_named("bernstein");
    method.reason = found + "the signs of a few coefficients along a ray decide";
  } else {
    method.reason = found + "f costs less than its coefficients along a ray; " + method.reason;
  }
}

}  // namespace

Wish second_wish(const Wish& wish) { return {search_named("isolate"), wish.inclusion}; }

Method choose_method(const Program& f, const Wish& wish, const KernelOptions& kernel) {
  Method method{wish.search, wish.inclusion, !wish.search && kernel.precision == f32, {}};
  if (!method.search) choose_search(method, f, kernel);
  if (!method.inclusion) {
    const bool too_long = kernel.backend == Backend::glsl && (!degree(f) || operations(f) > most_in_a_shader);
    method.inclusion = inclusion_named(too_long ? "ia" : "auto");
    if (too_long) method.reason += "; intervals, as tighter forms of such a formula make a shader too long";
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
