// Chebyshev polynomials as sums and products, as no processor has them.
#pragma once

#include "ir/program.h"

namespace imp {

// Every `chebyshev` as the doublings of ir/chebyshev.h, shared between degrees, and between a polynomial
// and its derivatives; those of degree 0 as a constant times x^0. Preserves bits.
Program reduce_chebyshev(const Program& program);

}  // namespace imp
