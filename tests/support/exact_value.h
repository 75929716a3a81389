// What a Program without phases is at a point, in 160 bits: for passes that keep the value and not the bits.
#pragma once

#include <span>
#include <vector>

#include "passes/constants.h"
#include "passes/inline.h"

namespace imp::test {

// Enclosures of the outputs, of the real numbers that the formulas stand for.
inline std::vector<Enclosure> exact_values(const Program& program, std::span<const double> inputs) {
  Program at_point;
  std::vector<Expr> constants;
  for (std::size_t i = 0; i < program.inputs.size(); ++i) {
    const Type type = program.inputs[i].type;
    Graph& graph = at_point.graph;
    constants.push_back(
        {&graph, type.is_truth() ? graph.constant(inputs[i] != 0) : graph.constant(type, inputs[i])});
  }
  const auto outputs = inline_program(program, constants);
  const auto values = constant_values(at_point);
  std::vector<Enclosure> result;
  for (const Expr output : outputs) result.push_back(*values[output.id.index]);
  return result;
}

// Whether both may be the same number, or neither is one.
inline bool same_value(const Enclosure& a, const Enclosure& b) {
  const bool a_empty = a.lo > a.hi, b_empty = b.lo > b.hi;
  return a_empty || b_empty ? a_empty == b_empty : a.lo <= b.hi && b.lo <= a.hi;
}

}  // namespace imp::test
