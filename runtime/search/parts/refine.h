// Refining: from a bracket to a root as good as the arithmetic.
#pragma once

#include "runtime/search/search.h"

namespace imp {

struct Refined {
  Expr s;
  Expr lo, hi;  // what is left of the bracket; where `enclosed`, f has proven, opposite signs at its ends
  Truth
      enclosed;  // enclosures of f in f64 have opposite signs on both sides of s, within certified_length of it
};

// Appends phases that find the root of a bracket in which f changes its sign. Newton's method on values proposes a
// place; bisection steps in where a step leaves the bracket or does not halve the last one (stiff f, such as x^500).
// Enclosures in double then look at both sides of it, and bisect where their signs do not confirm the place: values may
// be NaN, or wrong by more than f varies. Answers the middle of a bracket without a change of sign.
Refined refine(Program& program, const RayFunction& f, const Bracket& bracket);

// A hit whose place is not known as well as is promised is undecided.
Expr verdict_with(const Refined& root, Expr verdict);

}  // namespace imp
