#include "passes/chebyshev.h"

#include "ir/assert.h"
#include "ir/chebyshev.h"
#include "ir/expr.h"
#include "passes/rewrite.h"

namespace imp {

Program reduce_chebyshev(const Program& program) {
  return rewrite(program, [](Graph& graph, Id, const Node& node) {
    if (node.op != Op::chebyshev) return copy(graph, node);
    const Expr x{&graph, node.args[0]};
    const auto degree = graph.number(node.args[1]), order = graph.number(node.args[2]);
    IMP_ASSERT(degree && order, "a constant degree and order");
    const Expr value = chebyshev(x, static_cast<unsigned>(*degree), static_cast<unsigned>(*order),
                                 [x](double c) { return constant_like(x, c); });
    if (*degree > *order) return value.id;
    return (value * make(Op::powi, x, zero(x))).id;  // a constant, but where x has a value
  });
}

}  // namespace imp
