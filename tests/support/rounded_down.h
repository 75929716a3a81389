// Plain ops are faithfully rounded, in any direction: Programs in which they are rounded down.
#pragma once

#include "passes/rewrite.h"

namespace imp::test {

// Every + - × ÷ fma rounded down. There are no downward ops: down(e) is -up(-e).
inline Program rounded_down(const Program& program) {
  return rewrite(program, [](Graph& graph, Id, const Node& node) {
    const auto operand = [&](std::size_t i) { return Expr{&graph, node.args[i]}; };
    switch (node.op) {
      case Op::add: return (-add_up(-operand(0), -operand(1))).id;
      case Op::sub: return (-add_up(-operand(0), operand(1))).id;
      case Op::mul: return (-mul_up(-operand(0), operand(1))).id;
      case Op::div: return (-div_up(-operand(0), operand(1))).id;
      case Op::fma: return (-fma_up(-operand(0), operand(1), -operand(2))).id;
      default:      return copy(graph, node);
    }
  });
}

}  // namespace imp::test
