// Recognition of Chebyshev polynomials that are written out: as sums of powers, in Horner's form, by a
// recurrence. Their enclosures by powers are hopeless for high degrees, the one of the op is tight.
#pragma once

#include "ir/program.h"

namespace imp {

// `f` (f64, without phases) with every sum in which each part of degree 3 or more, in one sub-expression u, is
// a T_n(u) + b, n <= 100, over the op `chebyshev`; compared exactly, never nearly. Preserves the value.
Program recognize_chebyshev(const Program& f);

}  // namespace imp
