// Where the derivatives of Chebyshev polynomials have their extremes, and how large they are.
#pragma once

#include <vector>

namespace imp {

// A local extreme, at a place in [left, right] >= 0, with a value in [lo, hi].
struct ChebyshevExtreme {
  double left, right;
  double lo, hi;
};

// All extremes of the derivative of order k of T_n at x >= 0, k < n: the one at -x has the same value where
// n - k is even, else its negative.
std::vector<ChebyshevExtreme> chebyshev_extremes(unsigned n, unsigned k);

}  // namespace imp
