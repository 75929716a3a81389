// The value of a formula at a point, to 160 bits: what enclosures must hold, however tight they are.
#pragma once

#include <span>
#include <vector>

#include "ir/assert.h"
#include "passes/constants.h"
#include "passes/inline.h"

namespace imp::test {

// Of every output of `f` (constants unresolved) with these numbers for its inputs; truths are 0 and 1.
inline std::vector<Enclosure> exact_values(const Program& f, std::span<const double> inputs) {
  Program at;
  std::vector<Expr> place;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const Type type = f.inputs[i].type;
    place.push_back({&at.graph, type.is_truth() ? at.graph.constant(inputs[i] != 0)
                                                : at.graph.constant(type, inputs[i])});
  }
  const auto values = inline_program(f, place);
  const auto constants = constant_values(at);
  std::vector<Enclosure> result;
  for (const Expr& value : values) {
    IMP_ASSERT(constants[value.id.index], "a constant");
    result.push_back(*constants[value.id.index]);
  }
  return result;
}

// Whether both may be the same number, or neither is one.
inline bool same_value(const Enclosure& a, const Enclosure& b) {
  const bool a_empty = a.lo > a.hi, b_empty = b.lo > b.hi;
  return a_empty || b_empty ? a_empty == b_empty : a.lo <= b.hi && b.lo <= a.hi;
}

}  // namespace imp::test
