// Refining: from a bracket to a root as good as the arithmetic.
#pragma once

#include "runtime/search/search.h"

namespace imp {

struct Refined {
  Expr s;
  Truth enclosed;  // in f64: f changes its sign; in f32: within half of certified_length of s
};

// Appends phases that run Newton's method inside the bracket, and bisect where a step leaves it or does not halve the
// last one (stiff f, such as x^500). In floats f in double looks at both sides of what comes out, and where its signs do
// not say that the root is within certified_length, a second phase goes on in double until they do: near a tangent
// the rounding of f moves a root by more than that of s. Answers the middle of a bracket without a change of sign.
Refined refine(Program& program, const RayFunction& f, const Bracket& bracket);

// A hit whose place is not known as well as is promised is undecided.
Expr verdict_with(const Refined& root, Expr verdict);

}  // namespace imp
