// Precision: from the mathematics (f64, constants unresolved) to a Program that a backend runs.
#include "passes/precision.h"

#include <algorithm>

#include "ir/assert.h"
#include "passes/constants.h"
#include "passes/rewrite.h"

namespace imp {
namespace {

bool converts(Op op) { return info(op).kind == OpKind::convert; }

Id nearest(Graph& graph, Type type, const Enclosure& value) {
  if (type.is_truth()) return graph.constant(value.nearest != 0);
  return graph.constant(type, type == f32 ? value.nearest_float : value.nearest);
}

// A choice between equal constants, once they are numbers, is one more constant to those around it.
bool has_constant_expressions(const Graph& graph) {
  for (std::uint32_t i = 0; i < graph.size(); ++i) {
    const Node node = graph[Id{i}];
    const auto is_constant = [&](Id arg) { return graph[arg].op == Op::constant; };
    if (info(node.op).kind != OpKind::structure && std::ranges::all_of(node.args, is_constant)) return true;
  }
  return false;
}

Program with_constants_as_numbers(const Program& program, Type type) {
  const auto values = constant_values(program);
  const auto retype = [&](Type t) { return t.scalar == Scalar::truth ? t : Type{type.scalar, t.length}; };

  Program result = rewrite(
      program,
      [&](Graph& graph, Id old, const Node& node) {
        if (const auto& value = values[old.index]) return nearest(graph, node.type, *value);
        if (converts(node.op)) return node.args[0];
        return copy(graph, node);
      },
      retype);
  return compact(result);
}

}  // namespace

Program in_precision(const Program& program, Type type) {
  IMP_ASSERT(type.is_real(), "a type of numbers");
  Program result = with_constants_as_numbers(program, type);
  for (std::size_t size = ~0uz; has_constant_expressions(result.graph) && result.graph.size() < size;) {
    size = result.graph.size();
    result = with_constants_as_numbers(result, type);
  }
  for (auto& callee : result.callees) callee = std::make_shared<const Program>(in_precision(*callee, type));
  return result;
}

}  // namespace imp
