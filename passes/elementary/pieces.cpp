#include "passes/elementary/pieces.h"

#include "ir/assert.h"

namespace imp::elementary {

Expr polynomial(Expr x, std::span<const double> coefficients) {
  IMP_ASSERT(!coefficients.empty(), "a polynomial with a coefficient");
  Expr value = constant_like(x, coefficients.back());
  for (std::size_t i = coefficients.size() - 1; i-- > 0;) value = value * x + coefficients[i];
  return value;
}

}  // namespace imp::elementary
