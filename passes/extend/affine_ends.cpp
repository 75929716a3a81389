#include "passes/extend/affine_ends.h"

namespace imp::affine {

Expr larger(const Ends& a) { return is_symmetric(a) ? a.hi : max(a.nlo, a.hi); }

// The part 0 stays out of it: no form drops out by that, as its other parts tell (see `mul` in affine.cpp).
Expr sum_of_product_up(Expr a, Expr b, Expr c) {
  if (is_zero(a) || is_zero(b)) return c;
  return is_zero(c) ? mul_up(a, b) : fma_up(a, b, c);
}

Ends plus(const Ends& a, const Ends& b) { return {add_up(a.nlo, b.nlo), add_up(a.hi, b.hi)}; }

Ends plus_multiple(const Ends& sum, Expr factor, const Ends& d) {
  return {sum_of_product_up(factor, d.nlo, sum.nlo), sum_of_product_up(factor, d.hi, sum.hi)};
}

// By a negative factor the ends change places.
Ends plus_product(const Ends& sum, Expr factor, const Ends& d) {
  if (is_symmetric(d)) return plus_multiple(sum, abs(factor), d);
  const Truth upright = factor >= 0;
  return plus_multiple(sum, abs(factor), {select(upright, d.nlo, d.hi), select(upright, d.hi, d.nlo)});
}

// Largest where both are at upper or both at lower ends. No product stands alone: of errors that only pay for what is
// flushed it would be denormal, which is slow.
Ends plus_set_product(const Ends& sum, const Ends& a, const Ends& b) {
  return {max(sum_of_product_up(a.nlo, b.hi, sum.nlo), sum_of_product_up(a.hi, b.nlo, sum.nlo)),
          max(sum_of_product_up(a.nlo, b.nlo, sum.hi), sum_of_product_up(a.hi, b.hi, sum.hi))};
}

}  // namespace imp::affine
