#include "passes/extend/partial_derivatives.h"

#include "passes/differentiate.h"
#include "passes/extend/interval.h"

namespace imp {

std::optional<std::vector<Interval>> partial_derivatives(Op op, std::span<const Interval> operands) {
  Program alone;
  std::vector<std::string> names;
  std::vector<Id> args;
  for (const Interval& operand : operands) {
    const auto nlo = operand.hi.graph->number(operand.nlo.id), hi = operand.hi.graph->number(operand.hi.id);
    names.push_back("x" + std::to_string(names.size()));
    const Id input = add_input(alone, names.back(), f64, Rate::ray);
    args.push_back(nlo && hi && -*nlo == *hi ? alone.graph.constant(f64, *hi) : input);  // an exponent, say
  }
  alone.outputs.push_back({"f", alone.graph.add(op, args)});
  Diagnostics unused;
  auto derivatives = differentiate(alone, std::vector<std::string_view>(names.begin(), names.end()), unused);
  if (!derivatives) return std::nullopt;
  derivatives->outputs.erase(derivatives->outputs.begin());
  return enclose(*derivatives, operands, unused);
}

}  // namespace imp
