#include "passes/elementary/pieces.h"

#include <limits>

#include "ir/assert.h"
#include "ir/infinity.h"

namespace imp::elementary {

Expr polynomial(Expr x, std::span<const double> coefficients) {
  IMP_ASSERT(!coefficients.empty(), "a polynomial with a coefficient");
  Expr value = constant_like(x, coefficients.back());
  for (std::size_t i = coefficients.size() - 1; i-- > 0;) value = value * x + coefficients[i];
  return value;
}

Sum exact_sum(Expr big, Expr small) {
  const Expr high = big + small;
  return {high, small - (high - big)};
}

Expr upper_half(Expr x) {
  const Expr shifted = x * (x.type() == f32 ? 0x1p13 + 1 : 0x1p27 + 1);
  return shifted - (shifted - x);
}

Log2 log_of_2(Type type) {
  return type == f32 ? Log2{0x1.62e4p-1, 0x1.7f7d1cp-20} : Log2{0x1.62e42fefa38p-1, 0x1.ef35793c7673p-45};
}

Parts take_apart(Expr x) {
  const Expr e = make(Op::exponent, x);
  const Expr m = make(Op::scale2, x, -e);
  const Truth large = m > 0x1.6a09e6p0;
  return {select(large, e + 1, e), select(large, m * 0.5, m)};
}

Expr odd(Expr x, Expr value_at_abs_x, double tiny) {
  return select(abs(x) < tiny, x, select(x < 0, -value_at_abs_x, value_at_abs_x));
}

Expr on_positive(Expr x, Expr value) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  return select(x < infinity, select(x < 0, constant_like(x, nan), value), x);
}

}  // namespace imp::elementary
