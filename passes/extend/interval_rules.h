// Interval arithmetic as a number type that builds nodes: the natural interval extension (Moore
// 1966; Knoll et al. 2009, §3.2), with sets as IEEE 1788 has them and every rounding outward.
//
// An interval is carried as (-lo, hi), so that both ends round upward. The bounds are never NaN
// where the operands' are not; where `empty` holds they mean nothing.
#pragma once

#include <cmath>

#include "ir/expr.h"
#include "ir/replay.h"

namespace imp {

// What holds of the computed bounds (not only of the real values) for every box that may come. A rule
// may drop a fact, never invent one.
struct Facts {
  bool nonnegative = false;  // lo >= 0
  bool bounded = false;      // both ends are finite: they never overflow
};

struct Interval {
  Expr nlo, hi;      // [-nlo, hi]
  Truth empty;       // no point of the box has a value
  Truth continuous;  // every point of the box has a value, and f is continuous on the box
  Facts facts;

  Expr lo() const { return -nlo; }
};

// A truth over a box: it may hold at some point of it, it may fail at some point.
struct Possible {
  Truth yes, no;
};

// Whether the ends say anything: those of an empty set, or of a rule gone wrong, may have changed places.
inline Truth is_ordered(const Interval& a) { return a.lo() <= a.hi; }

// Ends that are NaN or not in order prove no sign. The empty set is not zero.
inline Truth is_positive(const Interval& a) { return a.nlo < 0 && is_ordered(a); }
inline Truth is_negative(const Interval& a) { return a.hi < 0 && is_ordered(a); }
inline Truth may_be_zero(const Interval& a) {
  return !(a.empty || ((a.nlo < 0 || a.hi < 0) && is_ordered(a)));
}

// The least number of `type` that is not below `value`, and no denormal, which a driver may take for zero.
inline Expr rounded_up(Graph& graph, Type type, double value) {
  const double least = type == f32 ? 0x1p-126 : 0x1p-1022;
  if (std::abs(value) < least && value != 0) value = value < 0 ? 0 : least;
  const Expr wide{&graph, graph.constant(f64, value)};
  return type == f32 ? narrow_up(wide) : wide;
}

// The interval [lo, hi], which is not empty; and {value}.
Interval interval(Expr nlo, Expr hi, Facts facts = {});
Interval point(Expr value, Facts facts = {});
Interval intersect(const Interval& a, const Interval& b);

// One rule an op, named after it, for ir/replay.h.
class IntervalRules {
 public:
  struct Value {
    Interval number;
    Possible truth;
    Value(Interval a) : number(a) {}
    Value(Possible a) : truth(a) {}
    operator const Interval&() const { return number; }
    operator const Possible&() const { return truth; }
  };

  Interval add(const Interval& a, const Interval& b) const;
  Interval sub(const Interval& a, const Interval& b) const;
  Interval mul(const Interval& a, const Interval& b) const;
  Interval square(const Interval& a) const;  // of one and the same value: tighter than mul(a, a)
  Interval div(const Interval& a, const Interval& b) const;
  Interval fma(const Interval& a, const Interval& b, const Interval& c) const;
  Interval neg(const Interval& a) const;
  Interval abs(const Interval& a) const;
  Interval min(const Interval& a, const Interval& b) const;
  Interval max(const Interval& a, const Interval& b) const;
  Interval sqrt(const Interval& a) const;
  Interval floor(const Interval& a) const;
  Interval ceil(const Interval& a) const;
  Interval sign(const Interval& a) const;
  Interval mod(const Interval& a, const Interval& b) const;
  Interval powi(const Interval& a, const Interval& n) const;
  Interval chebyshev(const Interval& a, const Interval& degree, const Interval& order) const;

  // elementary_rules.cpp
  Interval pow(const Interval& a, const Interval& b) const;
  Interval cbrt(const Interval& a) const;
  Interval exp(const Interval& a) const;
  Interval log(const Interval& a) const;
  Interval sin(const Interval& a) const;
  Interval cos(const Interval& a) const;
  Interval tan(const Interval& a) const;
  Interval asin(const Interval& a) const;
  Interval acos(const Interval& a) const;
  Interval atan(const Interval& a) const;
  Interval atan2(const Interval& y, const Interval& x) const;
  Interval sinh(const Interval& a) const;
  Interval cosh(const Interval& a) const;
  Interval tanh(const Interval& a) const;
  Interval asinh(const Interval& a) const;
  Interval acosh(const Interval& a) const;
  Interval atanh(const Interval& a) const;

  Possible lt(const Interval& a, const Interval& b) const;
  Possible le(const Interval& a, const Interval& b) const;
  Possible eq(const Interval& a, const Interval& b) const;
  Possible and_(const Possible& a, const Possible& b) const;
  Possible or_(const Possible& a, const Possible& b) const;
  Possible not_(const Possible& a) const;
  Interval select(const Possible& c, const Interval& a, const Interval& b) const;

 private:
  Interval or_second(const Interval& a, const Interval& b, const Interval& strict_result) const;
};

}  // namespace imp
