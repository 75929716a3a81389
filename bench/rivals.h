// Vector math libraries beside which the elementary functions are measured: SLEEF (its versions of at
// most 1.0 ulp) and libmvec of the C library (at most 4 ulps), 8 floats at a time on AVX2.
#pragma once

#include <cstddef>

#include "ir/op.h"

namespace imp::bench {

// f(x) or f(x, y) for n numbers, n a multiple of 8.
using ArrayFunction = void (*)(std::size_t n, const float* x, const float* y, float* result);

// Null where the library has no such function.
ArrayFunction sleef(Op op);
ArrayFunction libmvec(Op op);

// Both at once, by SLEEF.
void sleef_sincos(std::size_t n, const float* x, float* sines, float* cosines);

}  // namespace imp::bench
