// Refining: from a bracket to a root as good as the arithmetic.
#pragma once

#include "runtime/search/search.h"

namespace imp {

// Appends a phase that runs Newton's method inside the bracket, and bisects where a Newton step leaves the bracket or
// does not halve the last step (stiff f, such as x^500). In floats that only leads to the neighbourhood of the root,
// and steps with f in double follow: near a tangent the rounding of f moves a root by more than that of s. Answers the
// middle of a bracket without a change of sign.
Expr refine(Program& program, const RayFunction& f, const Bracket& bracket);

}  // namespace imp
