// Power strength reduction: integer powers become products, as no processor has a power.
#include "passes/power.h"

#include <cmath>

#include "ir/assert.h"
#include "ir/expr.h"
#include "passes/rewrite.h"

namespace imp {
namespace {

// The products of meaning::powi, in its order.
Expr products(Expr a, std::uint32_t n) {
  if (n == 1) return a;
  const Expr half = products(a, n / 2);
  const Expr square = half * half;
  return n % 2 == 1 ? square * a : square;
}

Expr power(Expr a, double n) {
  if (n == 0) return one(a);
  const Expr product = products(a, static_cast<std::uint32_t>(std::abs(n)));
  return n < 0 ? 1.0 / product : product;
}

}  // namespace

Program reduce_powers(const Program& program) {
  return rewrite(program, [](Graph& graph, Id, const Node& node) {
    if (node.op != Op::powi) return copy(graph, node);
    const auto exponent = graph.number(node.args[1]);
    IMP_ASSERT(exponent, "a constant exponent");
    return power({&graph, node.args[0]}, *exponent).id;
  });
}

}  // namespace imp
