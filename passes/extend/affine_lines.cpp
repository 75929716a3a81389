#include "passes/extend/affine_lines.h"

namespace imp::affine {

// For u > 0 and k = -a: 1/u + a u is largest at an end, and never below 2 sqrt(a). With a = 1/(near far) the
// ends are equally high.
Line reciprocal_line(Expr near, Expr far) {
  const Expr first = div_up(one(near), near), last = div_up(one(far), far), a = first * last;
  const Expr top = max(fma_up(a, near, first), fma_up(a, far, last));
  // sqrt(a) as computed is off by eps of itself.
  const Expr minus_bottom = mul_up(sqrt(a), constant_like(a, -2 * (1 - 2 * eps(a.type()))));
  return {-a, {minus_bottom, top}};
}

// sqrt(u) - k u is never above 1/(4 k), and smallest at an end. With k = 1/s for s = sqrt(lo) + sqrt(hi) the ends
// are equally low; k as computed is at least (1 - eps)/s, so s/4 (1 + 2 eps) will do. A root rounded upward is off
// by 4 eps of itself at most, however it was raised.
Line root_line(Expr lo, Expr hi) {
  const Expr first = sqrt_up(lo), last = sqrt_up(hi), sum = first + last, k = 1.0 / sum;
  const double e = eps(hi.type());
  const Expr down = constant_like(hi, -(1 - 4 * e));
  return {k,
          {max(fma_up(k, lo, mul_up(first, down)), fma_up(k, hi, mul_up(last, down))),
           mul_up(sum, constant_like(sum, 0.25 * (1 + 2 * e)))}};
}

}  // namespace imp::affine
