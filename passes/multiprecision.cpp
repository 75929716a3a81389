// Intervals at 160 bits: what MPFI lacks.
#include "passes/multiprecision.h"

namespace imp {

BigInterval operator+(const BigInterval& a, const BigInterval& b) {
  BigInterval result;
  mpfi_add(result, a, b);
  return result;
}

BigInterval operator-(const BigInterval& a, const BigInterval& b) {
  BigInterval result;
  mpfi_sub(result, a, b);
  return result;
}

BigInterval operator*(const BigInterval& a, const BigInterval& b) {
  BigInterval result;
  mpfi_mul(result, a, b);
  return result;
}

BigInterval operator/(const BigInterval& a, const BigInterval& b) {
  BigInterval result;
  mpfi_div(result, a, b);
  return result;
}

BigInterval power(const BigInterval& a, long n) {
  BigInterval base = a, result;
  if (n % 2 == 0) mpfi_abs(base, a);
  mpfr_pow_si(result.lo(), base.lo(), n, MPFR_RNDD);
  mpfr_pow_si(result.hi(), base.hi(), n, MPFR_RNDU);
  return result;
}

BigInterval power(const BigInterval& a, const BigInterval& b) {
  // Monotone in each operand, so the extremes lie at corners.
  BigInterval result, corner;
  bool first = true;
  for (mpfr_srcptr x : {a.lo(), a.hi()})
    for (mpfr_srcptr y : {b.lo(), b.hi()}) {
      mpfr_pow(corner.lo(), x, y, MPFR_RNDD);
      mpfr_pow(corner.hi(), x, y, MPFR_RNDU);
      result = first ? corner : hull(result, corner);
      first = false;
    }
  return result;
}

BigInterval min(const BigInterval& a, const BigInterval& b) {
  BigInterval result;
  mpfr_min(result.lo(), a.lo(), b.lo(), MPFR_RNDD);
  mpfr_min(result.hi(), a.hi(), b.hi(), MPFR_RNDU);
  return result;
}

BigInterval max(const BigInterval& a, const BigInterval& b) {
  BigInterval result;
  mpfr_max(result.lo(), a.lo(), b.lo(), MPFR_RNDD);
  mpfr_max(result.hi(), a.hi(), b.hi(), MPFR_RNDU);
  return result;
}

BigInterval hull(const BigInterval& a, const BigInterval& b) {
  BigInterval result;
  mpfr_min(result.lo(), a.lo(), b.lo(), MPFR_RNDD);
  mpfr_max(result.hi(), a.hi(), b.hi(), MPFR_RNDU);
  return result;
}

BigInterval floor(const BigInterval& a) {
  BigInterval result;
  mpfr_floor(result.lo(), a.lo());
  mpfr_floor(result.hi(), a.hi());
  return result;
}

BigInterval to_float(const BigInterval& a) {
  return {mpfr_get_flt(a.lo(), MPFR_RNDD), mpfr_get_flt(a.hi(), MPFR_RNDU)};
}

}  // namespace imp
