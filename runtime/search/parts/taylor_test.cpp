#include "runtime/search/parts/taylor_test.h"

namespace imp {

Truth taylor_test(const RayFunction& f, Expr a, Expr b) {
  const Expr half = 0.5 * (b - a);
  const Expr at_a = f.value(a), at_b = f.value(b);
  const Expr from_a = at_a + f.slope(a) * half, from_b = at_b - f.slope(b) * half;
  const Truth all_positive = at_a > 0 && at_b > 0 && from_a > 0 && from_b > 0;
  const Truth all_negative = at_a < 0 && at_b < 0 && from_a < 0 && from_b < 0;
  return !all_positive && !all_negative;
}

}  // namespace imp
