#include "passes/round_to_nearest.h"

#include <memory>

#include "passes/rewrite.h"

namespace imp {
namespace {

Op plain(Op op) {
  switch (op) {
    case Op::add_up:    return Op::add;
    case Op::mul_up:    return Op::mul;
    case Op::div_up:    return Op::div;
    case Op::sqrt_up:   return Op::sqrt;
    case Op::fma_up:    return Op::fma;
    case Op::narrow_up: return Op::narrow;
    default:            return op;
  }
}

}  // namespace

Program round_to_nearest(const Program& program) {
  Program result = rewrite(program, [](Graph& graph, Id, const Node& node) {
    if (!rounds_up(node.op)) return copy(graph, node);
    return graph.add(plain(node.op), node.args);
  });
  for (auto& callee : result.callees) callee = std::make_shared<const Program>(round_to_nearest(*callee));
  return result;
}

}  // namespace imp
