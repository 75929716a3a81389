// Ends of sets of real numbers: binary numbers of 128 bits and any exponent (Arb), rounded to the side that
// is asked for; infinities are ends.
#pragma once

#include <arb.h>

#include <utility>

namespace imp::test {

class Real {
 public:
  static constexpr slong precision = 128;

  explicit Real(double value = 0) {
    arf_init(x_);
    arf_set_d(x_, value);
  }
  Real(const Real& other) {
    arf_init(x_);
    arf_set(x_, other.x_);
  }
  Real(Real&& other) noexcept {
    arf_init(x_);
    arf_swap(x_, other.x_);
  }
  Real& operator=(const Real& other) {
    arf_set(x_, other.x_);
    return *this;
  }
  Real& operator=(Real&& other) noexcept {
    arf_swap(x_, other.x_);
    return *this;
  }
  ~Real() { arf_clear(x_); }

  arf_ptr get() { return x_; }
  arf_srcptr get() const { return x_; }

  int sign() const { return arf_sgn(x_); }
  bool is_finite() const { return arf_is_finite(x_) != 0; }
  double nearest() const { return arf_get_d(x_, ARF_RND_NEAR); }

  friend bool operator<(const Real& a, const Real& b) { return arf_cmp(a.x_, b.x_) < 0; }
  friend bool operator<=(const Real& a, const Real& b) { return arf_cmp(a.x_, b.x_) <= 0; }
  friend bool operator>(const Real& a, const Real& b) { return b < a; }
  friend bool operator>=(const Real& a, const Real& b) { return b <= a; }
  friend bool operator==(const Real& a, const Real& b) { return arf_cmp(a.x_, b.x_) == 0; }

  friend Real operator-(Real a) {
    arf_neg(a.x_, a.x_);
    return a;
  }

 private:
  arf_t x_;
};

enum class Toward : std::uint8_t { below, above };

inline arf_rnd_t rounding(Toward side) { return side == Toward::below ? ARF_RND_FLOOR : ARF_RND_CEIL; }
inline Real infinite(Toward side) {
  Real result;
  side == Toward::below ? arf_neg_inf(result.get()) : arf_pos_inf(result.get());
  return result;
}

// Sums, products and quotients. Infinity times zero is 0: the infinity is the limit of finite numbers.
inline Real add(const Real& a, const Real& b, Toward side) {
  Real result;
  arf_add(result.get(), a.get(), b.get(), Real::precision, rounding(side));
  return arf_is_nan(result.get()) ? infinite(side) : result;
}
inline Real mul(const Real& a, const Real& b, Toward side) {
  if (a.sign() == 0 || b.sign() == 0) return Real();
  Real result;
  arf_mul(result.get(), a.get(), b.get(), Real::precision, rounding(side));
  return result;
}
inline Real div(const Real& a, const Real& b, Toward side) {  // b is not 0
  if (a.sign() == 0 || !b.is_finite()) {
    if (a.is_finite() || a.sign() == 0) return Real();
    return infinite(side);
  }
  Real result;
  arf_div(result.get(), a.get(), b.get(), Real::precision, rounding(side));
  return result;
}
inline Real half_way(const Real& a, const Real& b) {  // exact, unless it takes very many bits
  Real result;
  arf_add(result.get(), a.get(), b.get(), 1024, ARF_RND_NEAR);
  arf_mul_2exp_si(result.get(), result.get(), -1);
  return result;
}

// An end of function(x) for a finite x: `function` is one of arb_….
template <class Function>
Real end_of(Function function, const Real& x, Toward side) {
  arb_t ball;
  arb_init(ball);
  arb_set_arf(ball, x.get());
  function(ball, ball, Real::precision);
  Real result;
  if (!arb_is_finite(ball))
    result = infinite(side);
  else if (side == Toward::below)
    arb_get_lbound_arf(result.get(), ball, Real::precision);
  else
    arb_get_ubound_arf(result.get(), ball, Real::precision);
  arb_clear(ball);
  return result;
}

}  // namespace imp::test
