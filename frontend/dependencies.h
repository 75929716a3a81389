// What the definitions and numbers of a file depend on.
#pragma once

#include "frontend/ast.h"
#include "ir/diagnostics.h"

namespace imp::syntax {

// Reports a definition in terms of itself, a number outside the surfaces that depends on x, y or z,
// and one that depends on a parameter or the time where it must be constant.
void check_dependencies(const Ast& ast, Diagnostics& diagnostics);

}  // namespace imp::syntax
