// The values of a part of a formula while its variables run through intervals, and a rule for every function:
// by the meanings of docs/language.md, on real numbers.
//
// At a jump or a pole a rule chooses one side of it (Choices). All choices together give sets that hold every
// value, so that a jump over 0 is no root.
#pragma once

#include <functional>
#include <vector>

#include "tests/support/real.h"

namespace imp::test {

struct RealSet {
  Real lo, hi;             // all values lie between them; lo > hi: there is none
  bool defined = true;     // there is a value everywhere: proven
  bool continuous = true;  // and it changes continuously: proven
  bool pole = false;       // where there is none, a kernel may see an infinity and compare with it
  bool truth = false;      // of a condition

  bool is_empty() const { return lo > hi; }
  bool is_point() const { return lo == hi; }
  bool may_be_zero() const { return lo.sign() <= 0 && hi.sign() >= 0; }

  static RealSet none(bool pole = false) {
    return {infinite(Toward::above), infinite(Toward::below), false, false, pole};
  }
  static RealSet all() { return {infinite(Toward::below), infinite(Toward::above), false, false, true}; }
};

// A path through the ways that the rules can go: run again until next() says that there are no more.
class Choices {
 public:
  // One of 0, …, n - 1.
  std::size_t operator()(std::size_t n) {
    if (at_ == taken_.size()) taken_.push_back({0, n});
    return taken_[at_++].way;
  }
  bool next() {
    taken_.resize(at_);
    at_ = 0;
    while (!taken_.empty() && taken_.back().way + 1 == taken_.back().of) taken_.pop_back();
    if (taken_.empty()) return false;
    ++taken_.back().way;
    return true;
  }

 private:
  struct Taken {
    std::size_t way, of;
  };
  std::vector<Taken> taken_;
  std::size_t at_ = 0;
};

class RealRules {
 public:
  explicit RealRules(Choices& choices) : choose_(choices) {}

  RealSet add(const RealSet& a, const RealSet& b) const {
    return with(a, b, test::add(a.lo, b.lo, Toward::below), test::add(a.hi, b.hi, Toward::above));
  }
  RealSet neg(const RealSet& a) const { return with(a, -a.hi, -a.lo); }
  RealSet sub(const RealSet& a, const RealSet& b) const { return add(a, neg(b)); }
  RealSet mul(const RealSet& a, const RealSet& b) const { return corners(a, b, test::mul); }
  RealSet div(const RealSet& a, const RealSet& b) {
    const RealSet divisor = without_zero(b);
    if (a.is_empty() || divisor.is_empty()) return none_of(a, divisor);
    if (divisor.hi.sign() <= 0) return neg(div_by_positive(a, neg(divisor)));
    return div_by_positive(a, divisor);
  }
  RealSet abs(const RealSet& a) const {
    if (a.lo.sign() >= 0) return a;
    if (a.hi.sign() <= 0) return neg(a);
    return with(a, Real(), std::max(-a.lo, a.hi));
  }
  RealSet sign(const RealSet& a) {
    if (a.is_empty()) return a;
    std::vector<int> signs;
    if (a.lo.sign() < 0) signs.push_back(-1);
    if (a.may_be_zero()) signs.push_back(0);
    if (a.hi.sign() > 0) signs.push_back(1);
    const Real result(signs[choose_(signs.size())]);
    return with(a, result, result, signs.size() > 1);
  }
  RealSet floor(const RealSet& a) {
    if (a.is_empty()) return a;
    Real lo = a.lo, hi = a.hi;
    arf_floor(lo.get(), lo.get());
    arf_floor(hi.get(), hi.get());
    const double steps = test::add(hi, -lo, Toward::above).nearest();
    if (!(steps <= 3)) return with(a, lo, hi, true);
    if (steps > 0) {
      const Real chosen(static_cast<double>(choose_(static_cast<std::size_t>(steps) + 1)));
      lo = test::add(lo, chosen, Toward::below);
    }
    return with(a, lo, steps > 0 ? lo : hi, steps > 0);
  }
  RealSet ceil(const RealSet& a) { return neg(floor(neg(a))); }
  RealSet mod(const RealSet& a, const RealSet& b) { return sub(a, mul(b, floor(div(a, b)))); }

  // Where a has no value they are b; where b has none, they have none.
  RealSet min(const RealSet& a, const RealSet& b) {
    if (stands_for_b(a)) return instead(a, b);
    return with(a, b, std::min(a.lo, b.lo), std::min(a.hi, b.hi));
  }
  RealSet max(const RealSet& a, const RealSet& b) {
    if (stands_for_b(a)) return instead(a, b);
    return with(a, b, std::max(a.lo, b.lo), std::max(a.hi, b.hi));
  }

  RealSet sqrt(const RealSet& a) const { return rising(arb_sqrt, within(a, 0, false)); }
  RealSet cbrt(const RealSet& a) const {
    return rising(
        [](arb_ptr r, arb_srcptr x, slong bits) {
          const bool below = arb_is_negative(x) != 0;
          if (below) arb_neg(r, x);
          arb_root_ui(r, below ? r : x, 3, bits);
          if (below) arb_neg(r, r);
        },
        a);
  }
  RealSet exp(const RealSet& a) const { return at_least(0, rising(arb_exp, a, Real())); }
  RealSet log(const RealSet& a) const { return rising(arb_log, within(a, 0, true)); }
  RealSet sinh(const RealSet& a) const { return rising(arb_sinh, a); }
  RealSet cosh(const RealSet& a) const { return at_least(1, rising(arb_cosh, abs(a))); }
  RealSet tanh(const RealSet& a) const { return rising(arb_tanh, a, Real(-1), Real(1)); }
  RealSet asinh(const RealSet& a) const { return rising(arb_asinh, a); }
  RealSet acosh(const RealSet& a) const { return at_least(0, rising(arb_acosh, within(a, 1, false))); }
  RealSet atanh(const RealSet& a) const { return rising(arb_atanh, at_most(within(a, -1, true), 1, true)); }
  RealSet asin(const RealSet& a) const { return rising(arb_asin, at_most(within(a, -1, false), 1, false)); }
  RealSet acos(const RealSet& a) const {
    return neg(rising(minus_acos, at_most(within(a, -1, false), 1, false)));
  }
  RealSet atan(const RealSet& a) const { return rising(arb_atan, a, Real(-1.6), Real(1.6)); }
  RealSet sin(const RealSet& a) const { return wave(arb_sin, a); }
  RealSet cos(const RealSet& a) const { return wave(arb_cos, a); }
  RealSet tan(const RealSet& a) {
    if (a.is_empty()) return a;
    const Real lo = half_turn(a.lo, Toward::below), hi = half_turn(a.hi, Toward::above);
    if (lo == hi) return rising(arb_tan, a);
    const double poles = test::add(hi, -lo, Toward::above).nearest();
    if (!(poles <= 1)) return all_of(a, true);
    // An argument that is known to less than its distance from the pole is on both sides.
    const bool left = choose_(2) == 0;
    const Real end = end_of(arb_tan, left ? a.lo : a.hi, left ? Toward::below : Toward::above);
    RealSet result = with(a, left ? end : infinite(Toward::below), left ? infinite(Toward::above) : end);
    result.defined = result.continuous = false, result.pole = true;
    return end.is_finite() &&
                   (left ? half_turn(a.lo, Toward::above) == lo : half_turn(a.hi, Toward::below) == hi)
               ? result
               : all_of(a, true);
  }
  // The angle of (x, y): it jumps where y is 0 and x negative. What it is at the origin is no one's promise.
  RealSet atan2(const RealSet& y, const RealSet& x) {
    if (y.is_empty() || x.is_empty()) return RealSet::none(y.pole || x.pole);
    if (x.lo.sign() > 0) return with(y, x, atan(corners(y, x, test::div)));
    if (y.lo.sign() > 0) return with(y, x, quarter(1, neg(atan(corners(x, y, test::div)))));
    if (y.hi.sign() < 0) return with(y, x, quarter(-1, neg(atan(corners(x, y, test::div)))));
    const bool upper = choose_(2) == 0;
    const RealSet angles = quarter(upper ? 1 : -1, RealSet{Real(-1.6), Real(1.6)});
    RealSet result = with(y, x, angles);
    const bool origin = x.hi.sign() >= 0;
    result.continuous = false, result.defined &= !origin, result.pole |= origin;
    return result;
  }

  RealSet power(const RealSet& a, long n) {
    if (n == 0) return a.is_empty() ? a : with(a, Real(1), Real(1));
    if (n < 0) return div({Real(1), Real(1)}, power(a, -n));
    const auto raise = [n](arb_ptr r, arb_srcptr x, slong bits) {
      arb_pow_ui(r, x, static_cast<ulong>(n), bits);
    };
    return n % 2 == 0 ? at_least(0, rising(raise, abs(a))) : rising(raise, a);
  }
  // The real power: of numbers from 0 on; 0^0 is 1.
  RealSet pow(const RealSet& a, const RealSet& b) {
    const RealSet base = within(a, 0, false);
    if (base.is_empty() || b.is_empty()) return none_of(base, b);
    RealSet result = exp(mul(b, rising(arb_log, base)));
    if (base.lo.sign() > 0 || b.lo.sign() > 0) return result;
    result.continuous = false, result.lo = Real();
    if (b.may_be_zero()) result.hi = std::max(result.hi, Real(1));  // 0^0
    if (b.lo.sign() < 0) result.hi = infinite(Toward::above), result.defined = false, result.pole = true;
    return result;
  }
  // The Chebyshev polynomial of degree n: between -1 and 1 a cosine, beyond these it grows.
  RealSet chebyshev(const RealSet& a, ulong n) const {
    if (a.is_empty() || n == 0) return a.is_empty() ? a : with(a, Real(1), Real(1));
    const auto value = [n](arb_ptr r, arb_srcptr x, slong bits) { arb_chebyshev_t_ui(r, n, x, bits); };
    RealSet result = with(a, infinite(Toward::above), infinite(Toward::below));
    const auto join = [&](const Real& lo, const Real& hi) {
      result.lo = std::min(result.lo, lo), result.hi = std::max(result.hi, hi);
    };
    const Real one(1), minus_one(-1);
    if (a.lo < one && a.hi > minus_one) {
      RealSet inner{std::max(a.lo, minus_one), std::min(a.hi, one)};
      const RealSet cosine =
          cos(mul(acos(inner), {Real(static_cast<double>(n)), Real(static_cast<double>(n))}));
      join(cosine.lo, cosine.hi);
    }
    if (a.hi >= one) join(end_of(value, std::max(a.lo, one), Toward::below), end_of_finite(value, a.hi));
    if (a.lo <= minus_one) {
      const Real least = end_of(value, -std::min(a.hi, minus_one), Toward::below);
      const Real most = end_of_finite(value, -a.lo);
      n % 2 == 0 ? join(least, most) : join(-most, -least);
    }
    return result;
  }

  static RealSet pi() {
    const auto value = [](arb_ptr r, arb_srcptr, slong bits) { arb_const_pi(r, bits); };
    return {end_of(value, Real(), Toward::below), end_of(value, Real(), Toward::above)};
  }

  // Conditions. What has no value compares as false, an infinity of a pole in either way.
  RealSet less(const RealSet& a, const RealSet& b, bool or_equal) {
    const bool values = !a.is_empty() && !b.is_empty(), poles = a.pole || b.pole;
    const bool yes = values && (or_equal ? a.lo <= b.hi : a.lo < b.hi);
    const bool no = !values || (or_equal ? b.lo < a.hi : b.lo <= a.hi) || !a.defined || !b.defined;
    return condition(yes || poles, no || poles);
  }
  RealSet both(const RealSet& a, const RealSet& b, bool conjunction) const {
    const bool decides = conjunction ? !a.truth : a.truth;  // one operand alone
    const bool other = conjunction ? !b.truth : b.truth;
    RealSet result = a;
    result.truth = conjunction ? a.truth && b.truth : a.truth || b.truth;
    result.continuous =
        (a.continuous && b.continuous) || (a.continuous && decides) || (b.continuous && other);
    return result;
  }
  RealSet negation(RealSet a) const {
    a.truth = !a.truth;
    return a;
  }
  RealSet select(const RealSet& condition, const RealSet& a, const RealSet& b) const {
    RealSet result = condition.truth ? a : b;
    result.continuous &= condition.continuous;
    return result;
  }

 private:
  static RealSet with(const RealSet& a, Real lo, Real hi, bool jumps = false) {
    if (a.is_empty()) return a;
    return {std::move(lo), std::move(hi), a.defined, a.continuous && !jumps, a.pole};
  }
  static RealSet with(const RealSet& a, const RealSet& b, Real lo, Real hi) {
    if (a.is_empty() || b.is_empty()) return RealSet::none(a.pole || b.pole);
    return {std::move(lo), std::move(hi), a.defined && b.defined, a.continuous && b.continuous,
            a.pole || b.pole};
  }
  static RealSet with(const RealSet& a, const RealSet& b, const RealSet& hull) {
    return with(a, b, hull.lo, hull.hi);
  }
  static RealSet none_of(const RealSet& a, const RealSet& b) { return RealSet::none(a.pole || b.pole); }
  static RealSet all_of(const RealSet& a, bool pole) {
    RealSet result = RealSet::all();
    result.pole = pole || a.pole;
    return result;
  }
  RealSet condition(bool yes, bool no) {
    RealSet result{Real(), Real()};
    result.continuous = yes != no;
    result.truth = yes && (!no || choose_(2) == 0);
    return result;
  }

  using End = Real (*)(const Real&, const Real&, Toward);
  static RealSet corners(const RealSet& a, const RealSet& b, End op) {
    if (a.is_empty() || b.is_empty()) return RealSet::none(a.pole || b.pole);
    RealSet result = with(a, b, op(a.lo, b.lo, Toward::below), op(a.lo, b.lo, Toward::above));
    for (const auto& [x, y] : {std::pair{&a.lo, &b.hi}, {&a.hi, &b.lo}, {&a.hi, &b.hi}}) {
      result.lo = std::min(result.lo, op(*x, *y, Toward::below));
      result.hi = std::max(result.hi, op(*x, *y, Toward::above));
    }
    return result;
  }

  static RealSet div_by_positive(const RealSet& a, const RealSet& b) {  // from 0 on, but not 0
    const auto end = [&](const Real& x, Toward side) {
      const Real& y = (x.sign() < 0) == (side == Toward::below) ? b.lo : b.hi;  // the farther quotient
      if (x.sign() == 0) return Real();
      return y.sign() == 0 ? infinite(x.sign() < 0 ? Toward::below : Toward::above) : test::div(x, y, side);
    };
    return with(a, b, end(a.lo, Toward::below), end(a.hi, Toward::above));
  }

  // a beyond an end of a domain, which may itself be out of it; there is a pole then.
  static RealSet within(RealSet a, double least, bool open) {
    if (a.is_empty()) return a;
    const Real end(least);
    if (a.hi < end || (open && a.hi <= end)) return RealSet::none(a.pole || (open && a.hi == end));
    if (a.lo > end || (!open && a.lo == end)) return a;
    a.lo = end;
    a.defined = a.continuous = false, a.pole |= open;
    return a;
  }
  RealSet at_most(const RealSet& a, double most, bool open) const { return neg(within(neg(a), -most, open)); }
  static RealSet at_least(double end, RealSet a) {  // which is known: a bound may be less by its rounding
    if (!a.is_empty()) a.lo = std::max(a.lo, Real(end));
    return a;
  }

  // A half of a, on one side of 0.
  RealSet without_zero(RealSet a) {
    if (a.is_empty() || !a.may_be_zero()) return a;
    const bool below = a.lo.sign() < 0, above = a.hi.sign() > 0;
    if (!below && !above) return RealSet::none(true);
    const bool negative = below && (!above || choose_(2) == 0);
    (negative ? a.hi : a.lo) = Real();
    a.defined = a.continuous = false, a.pole = true;
    return a;
  }

  bool stands_for_b(const RealSet& a) { return a.is_empty() || (!a.defined && choose_(2) == 0); }
  static RealSet instead(const RealSet& a, RealSet b) {
    b.continuous &= a.is_empty() && !a.pole;
    if (a.pole) b.defined = false, b.pole = true;
    return b;
  }

  template <class Function>
  static RealSet rising(Function function, const RealSet& a, const Real& at_least = infinite(Toward::below),
                        const Real& at_most = infinite(Toward::above)) {
    if (a.is_empty()) return a;
    const auto end = [&](const Real& x, Toward side) {
      return x.is_finite() ? end_of(function, x, side) : x.sign() < 0 ? at_least : at_most;
    };
    return with(a, end(a.lo, Toward::below), end(a.hi, Toward::above));
  }
  template <class Function>
  static RealSet wave(Function function, const RealSet& a) {
    if (a.is_empty()) return a;
    RealSet result = with(a, Real(-1), Real(1));
    if (!a.lo.is_finite() || !a.hi.is_finite()) return result;
    arb_t ball;
    arb_init(ball);
    arb_set_interval_arf(ball, a.lo.get(), a.hi.get(), Real::precision);
    function(ball, ball, Real::precision);
    Real lo, hi;
    arb_get_interval_arf(lo.get(), hi.get(), ball, Real::precision);
    arb_clear(ball);
    result.lo = std::max(result.lo, lo), result.hi = std::min(result.hi, hi);
    return result;
  }
  static void minus_acos(arb_ptr r, arb_srcptr x, slong bits) {
    arb_acos(r, x, bits);
    arb_neg(r, r);
  }
  template <class Function>
  static Real end_of_finite(Function function, const Real& x) {
    return x.is_finite() ? end_of(function, x, Toward::above) : infinite(Toward::above);
  }

  // floor(x/pi + 1/2): which branch of the tangent.
  static Real half_turn(const Real& x, Toward side) {
    if (!x.is_finite()) return infinite(side);
    Real result = end_of(
        [](arb_ptr r, arb_srcptr y, slong bits) {
          arb_t pi, half;
          arb_init(pi), arb_init(half);
          arb_const_pi(pi, bits), arb_set_d(half, 0.5);
          arb_div(r, y, pi, bits);
          arb_add(r, r, half, bits);
          arb_clear(pi), arb_clear(half);
        },
        x, side);
    arf_floor(result.get(), result.get());
    return result;
  }
  // A quarter of a turn, `sign`, and an angle.
  RealSet quarter(int sign, const RealSet& angle) const {
    const RealSet turn = mul(pi(), {Real(0.5), Real(0.5)});
    return add(sign < 0 ? neg(turn) : turn, angle);
  }

  Choices& choose_;
};

}  // namespace imp::test
