// Exponents that may be integers: x^2 is defined for all x, the real power x^b for x >= 0 only.
#pragma once

#include "ir/diagnostics.h"
#include "ir/program.h"

namespace imp {

// False, and an error each, if constant exponents of real powers in `f` (f64, constants unresolved) may be
// integers, as far as 160 bits tell: those would be other powers.
bool check_exponents(const Program& f, Diagnostics& diagnostics);

}  // namespace imp
