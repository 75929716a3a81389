// Refining: from a bracket to a root as good as the arithmetic.
#pragma once

#include "runtime/search/search.h"

namespace imp {

// Appends phases that run Newton's method inside the bracket, and bisect where a step leaves it or does not halve the
// last one (stiff f, such as x^500). In floats a second phase follows with f in double, until the signs of f there say
// that the root is within certified_length: near a tangent the rounding of f moves a root by more than that of s.
// Answers the middle of a bracket without a change of sign.
Expr refine(Program& program, const RayFunction& f, const Bracket& bracket);

}  // namespace imp
