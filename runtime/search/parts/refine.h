// Refining: from a bracket to a root as good as the arithmetic.
#pragma once

#include "runtime/search/search.h"

namespace imp {

struct Refined {
  Expr s;
  Expr lo, hi;     // what is left of the bracket, with s in it
  Truth enclosed;  // enclosures in f64 have opposite signs at lo and hi, within certified_length of s
};

// Appends phases that find the root of a bracket in which f changes its sign. Values propose a place: by Newton's
// method, with bisection where a step leaves the bracket or does not halve the last one (stiff f, such as x^500).
// Enclosures in double decide: they look at both sides of the place, and bisect where their signs do not confirm it.
// Values may be NaN, or wrong by more than f varies. Without a change of sign s is the middle of the bracket.
Refined refine(Program& program, const RayFunction& f, const Bracket& bracket);

// A hit whose place is not known as well as is promised is undecided.
Expr verdict_with(const Refined& root, Expr verdict);

}  // namespace imp
