// Power strength reduction: integer powers become products, as no processor has a power.
#include "passes/power.h"

#include <cmath>
#include <functional>

#include "ir/addition_chain.h"
#include "ir/assert.h"
#include "ir/expr.h"
#include "passes/rewrite.h"

namespace imp {
namespace {

Expr power(Expr a, double n) {
  if (n == 0) return select(equal(a, a), one(a), a);  // NaN stays
  const Expr product = positive_power(a, static_cast<std::uint32_t>(std::abs(n)), std::multiplies<Expr>());
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
