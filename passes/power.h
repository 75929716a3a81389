// Power strength reduction: integer powers become products, as no processor has a power.
#pragma once

#include "ir/program.h"

namespace imp {

// Every powi as the products of meaning::powi, of which powers of the same base share what they can, as
// 1/… for negative exponents, and as 1 or NaN for the exponent 0. Preserves bits.
Program reduce_powers(const Program& program);

}  // namespace imp
