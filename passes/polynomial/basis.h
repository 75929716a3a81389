// Changes to the Bernstein basis of [0, 1]: from values at fixed points, and from powers.
#pragma once

#include "passes/polynomial/weights.h"

namespace imp {

// The degree + 1 points of [0, 1] at which a polynomial is sampled, from 0 to 1: those of Chebyshev and
// Lobatto, where the change of basis grows the least, rounded to multiples of 2^-12, so that they lie
// symmetric about 1/2 and are exact in the pieces that bisection makes.
std::vector<double> sample_points(std::uint32_t degree);

// The Bernstein coefficients are this matrix times the values at exactly these points.
Matrix from_samples(std::uint32_t degree, Type type);

// The same for the coefficients of 1, t, t^2, ….
Matrix from_powers(std::uint32_t degree, Type type);

// n! / (n - k)!
BigInterval falling_factorial(std::uint32_t n, std::uint32_t k);

}  // namespace imp
