// Composition: one straight-line Program inside another.
#pragma once

#include <span>
#include <vector>

#include "ir/expr.h"
#include "ir/program.h"

namespace imp {

// The outputs of `program`, which has no phases and calls nothing, for the given inputs, in their
// graph. Names of nodes are carried over.
std::vector<Expr> inline_program(const Program& program, std::span<const Expr> inputs);

}  // namespace imp
