// Descartes' rule of signs for Bernstein coefficients that are known up to rounding.
#pragma once

#include <span>

#include "passes/extend/interval_rules.h"

namespace imp {

// How often the coefficients change their sign at most, zeros left out and whatever the signs that are
// not known: a number of the type of their bounds. The polynomial has no more zeros than that within (0, 1),
// counted with multiplicity, and if none is 0 at both ends then fewer by an even number (Lane and
// Riesenfeld 1981). So where it is 1 and the ends have proven signs that differ there is exactly one
// zero within. Where it is 0 there is none or the polynomial is 0 everywhere, as it may be if no coefficient has
// a proven sign. A NaN may be anything.
Expr most_sign_variations(std::span<const Interval> coefficients);

}  // namespace imp
