#include "passes/exponents.h"

#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "passes/constants.h"
#include "passes/rewrite.h"

namespace imp {
namespace {

// The exponents of the real powers that are needed.
std::vector<Id> exponents(const Program& f) {
  const std::vector<bool> live = live_nodes(f);
  std::vector<Id> result;
  for (std::uint32_t i = 0; i < live.size(); ++i)
    if (const Node node = f.graph[Id{i}]; live[i] && node.op == Op::pow) result.push_back(node.args[1]);
  return result;
}

// One of the integers that a constant may be; nothing where it is none, or has no value.
std::optional<double> possible_integer(const Enclosure& constant) {
  const double least = std::ceil(constant.lo) + 0.0;  // not -0
  return least <= constant.hi ? std::optional(least) : std::nullopt;
}

struct Doubt {
  Id exponent;
  double integer;
  Id distance;  // of the two
};

}  // namespace

// Where doubles do not tell an exponent from an integer, the 160 bits of their difference may.
bool check_exponents(const Program& f, Diagnostics& diagnostics) {
  const std::vector<Id> all = exponents(f);
  if (all.empty()) return true;
  Program program = f;
  std::vector<Doubt> doubts;
  const auto values = constant_values(f);
  for (const Id exponent : all)
    if (const auto& value = values[exponent.index])
      if (const auto k = possible_integer(*value))
        doubts.push_back(
            {exponent, *k, program.graph.add(Op::sub, {exponent, program.graph.constant(f64, *k)})});
  if (doubts.empty()) return true;

  bool good = true;
  const auto distances = constant_values(program);
  for (const Doubt& doubt : doubts) {
    if (!possible_integer(*distances[doubt.distance.index])) continue;
    diagnostics.error(
        f.graph.span(doubt.exponent),
        fmt::format("whether this exponent is the integer {0} cannot be decided; if it is, write {0}",
                    doubt.integer));
    good = false;
  }
  return good;
}

}  // namespace imp
