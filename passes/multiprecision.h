// Intervals at 160 bits on MPFI, with what MPFI lacks: values that own their memory, powers, and the
// functions with jumps. For constants only.
#pragma once

#include <mpfi.h>

#include <utility>

namespace imp {

class BigInterval {
 public:
  static constexpr mpfr_prec_t precision = 160;

  BigInterval(double value = 0) : BigInterval(value, value) {}
  BigInterval(double lo, double hi) {
    mpfi_init2(x_, precision);
    mpfi_interv_d(x_, lo, hi);
  }
  BigInterval(const BigInterval& other) {
    mpfi_init2(x_, precision);
    mpfi_set(x_, other.x_);
  }
  BigInterval& operator=(const BigInterval& other) {
    mpfi_set(x_, other.x_);
    return *this;
  }
  ~BigInterval() { mpfi_clear(x_); }

  operator mpfi_ptr() { return x_; }
  operator mpfi_srcptr() const { return x_; }
  mpfr_ptr lo() { return &x_->left; }
  mpfr_ptr hi() { return &x_->right; }
  mpfr_srcptr lo() const { return &x_->left; }
  mpfr_srcptr hi() const { return &x_->right; }

  bool is_point() const { return mpfr_equal_p(lo(), hi()) != 0; }
  bool is(double value) const { return mpfr_cmp_d(lo(), value) == 0 && mpfr_cmp_d(hi(), value) == 0; }
  bool holds_zero() const { return mpfr_sgn(lo()) <= 0 && mpfr_sgn(hi()) >= 0; }
  bool is_bounded() const { return mpfr_number_p(lo()) != 0 && mpfr_number_p(hi()) != 0; }
  bool is_nan() const { return mpfr_nan_p(lo()) != 0 || mpfr_nan_p(hi()) != 0; }

 private:
  mpfi_t x_;
};

BigInterval operator+(const BigInterval& a, const BigInterval& b);
BigInterval operator-(const BigInterval& a, const BigInterval& b);
BigInterval operator*(const BigInterval& a, const BigInterval& b);
BigInterval operator/(const BigInterval& a, const BigInterval& b);

// a^n for n > 0.
BigInterval power(const BigInterval& a, long n);

// a^b for a >= 0; 0^0 is 1.
BigInterval power(const BigInterval& a, const BigInterval& b);

BigInterval min(const BigInterval& a, const BigInterval& b);
BigInterval max(const BigInterval& a, const BigInterval& b);
BigInterval hull(const BigInterval& a, const BigInterval& b);
BigInterval floor(const BigInterval& a);

// With ends that are floats, outward.
BigInterval to_float(const BigInterval& a);

}  // namespace imp
