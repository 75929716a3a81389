// Refining: from a bracket to a root as good as the arithmetic.
#pragma once

#include "runtime/search/search.h"

namespace imp {

// Appends a phase that runs Newton's method inside the bracket [a, b], where f has the sign
// `sign_a` at a and the other one at b, and bisects where a Newton step leaves the bracket or does
// not halve the last step (stiff f, such as x^500). In floats three more steps follow with f in double: near a
// tangent the rounding of f moves a root by more than that of s. Lanes outside `enter` answer the middle.
Expr refine(Program& program, const RayFunction& f, Expr a, Expr b, Expr sign_a, Truth enter);

}  // namespace imp
