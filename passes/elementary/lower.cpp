#include "passes/elementary/lower.h"

#include "passes/elementary/functions.h"
#include "passes/rewrite.h"

namespace imp {

Program lower_elementary(const Program& program) {
  return rewrite(program, [](Graph& graph, Id, const Node& node) {
    const auto arg = [&](std::size_t i) { return Expr{&graph, node.args[i]}; };
    switch (node.op) {
      case Op::exp:   return elementary::exp(arg(0)).id;
      case Op::sinh:  return elementary::sinh(arg(0)).id;
      case Op::cosh:  return elementary::cosh(arg(0)).id;
      case Op::tanh:  return elementary::tanh(arg(0)).id;
      case Op::log:   return elementary::log(arg(0)).id;
      case Op::asinh: return elementary::asinh(arg(0)).id;
      case Op::acosh: return elementary::acosh(arg(0)).id;
      case Op::atanh: return elementary::atanh(arg(0)).id;
      case Op::pow:   return elementary::pow(arg(0), arg(1)).id;
      case Op::cbrt:  return elementary::cbrt(arg(0)).id;
      case Op::sin:   return elementary::sin(arg(0)).id;
      case Op::cos:   return elementary::cos(arg(0)).id;
      case Op::tan:   return elementary::tan(arg(0)).id;
      case Op::asin:  return elementary::asin(arg(0)).id;
      case Op::acos:  return elementary::acos(arg(0)).id;
      case Op::atan:  return elementary::atan(arg(0)).id;
      case Op::atan2: return elementary::atan2(arg(0), arg(1)).id;
      default:        return copy(graph, node);
    }
  });
}

}  // namespace imp
