// Chebyshev polynomials and their derivatives in 160 bits, by the recurrence of Gegenbauer's polynomials:
// another way than the one that is tested.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "passes/multiprecision.h"

namespace imp::test {

inline BigInterval quotient(const BigInterval& a, double b) {
  BigInterval result;
  mpfi_div_d(result, a, b);
  return result;
}

// The derivative of order k of T_n: 2^(k-1) (k-1)! n C_(n-k)^(k), and for k = 0 its own recurrence.
inline BigInterval chebyshev_reference(const BigInterval& x, unsigned n, unsigned k) {
  BigInterval before(0), value(1);
  if (k == 0) before = x;  // T_-1
  for (unsigned m = 1; m <= n - k; ++m) {
    const BigInterval next =
        k == 0
            ? BigInterval(2) * x * value - before
            : quotient(BigInterval(2.0 * (m + k - 1)) * x * value - BigInterval(m + 2.0 * k - 2) * before, m);
    before = value;
    value = next;
  }
  if (k == 0) return value;
  double factor = n;
  for (unsigned i = 1; i < k; ++i) factor *= 2.0 * i;
  return BigInterval(factor) * value;
}

inline double nearest(const BigInterval& a) {
  mpfr_t middle;
  mpfr_init2(middle, BigInterval::precision + 10);
  mpfi_mid(middle, a);
  const double value = mpfr_get_d(middle, MPFR_RNDN);
  mpfr_clear(middle);
  return value;
}

inline double critical_point(unsigned n, unsigned j) { return std::cos(std::numbers::pi * j / n); }

}  // namespace imp::test
