// The interval rules of the elementary functions: the function at the ends of monotone pieces, widened
// by the bound of its error; and its extremes, where one may lie inside.
#include <array>
#include <cmath>
#include <initializer_list>

#include "ir/infinity.h"
#include "ir/meaning.h"
#include "passes/constants.h"
#include "passes/elementary/bounds.h"
#include "passes/extend/interval_rules.h"

namespace imp {
namespace {

// Doubles above pi and its like; the largest double below 1/pi, and the next one.
constexpr double above_pi = 0x1.921fb54442d19p+1;
constexpr double below_inverse_pi = 0x1.45f306dc9c882p-2, above_inverse_pi = 0x1.45f306dc9c883p-2;

// Bounds of a function at a point.
struct Bounds {
  Expr above, minus_below;
};

// The tightest ones where the point is a constant: range analysis folds.
Bounds bounds_at(Op op, std::initializer_list<Expr> args) {
  const Expr first = *args.begin();
  Graph& graph = *first.graph;
  std::array<double, 2> values{};
  bool constant = true;
  std::size_t count = 0;
  for (const Expr arg : args) {
    const auto number = graph.number(arg.id);
    constant &= number.has_value();
    values[count++] = number.value_or(0);
  }
  if (constant) {
    Enclosure value = constant_value(op, std::span(values).first(count));
    if (value.lo > value.hi)  // at a pole: its limit
      value.lo = value.hi = meaning::real<double>(op, values[0], values[1], 0);
    return {rounded_up(graph, first.type(), value.hi), rounded_up(graph, first.type(), -value.lo)};
  }
  const Expr value = count == 1 ? make(op, first) : make(op, first, args.begin()[1]);
  return {elementary::above(op, value), elementary::minus_below(op, value)};
}

Expr at_most(Expr a, double limit) { return min(rounded_up(*a.graph, a.type(), limit), a); }  // NaN stays

enum class Edges : std::int8_t { closed, open };

// The part of `a` in the domain [lo, hi], or (lo, hi), of a function.
Interval in_domain(const Interval& a, double lo, double hi, Edges ends = Edges::closed) {
  Interval part = a;
  const auto inside = [&](Expr minus_end, double limit) {
    return ends == Edges::open ? minus_end < -limit : minus_end <= -limit;
  };
  if (lo > -infinity && !(lo == 0 && a.facts.nonnegative && ends == Edges::closed)) {
    part.nlo = min(a.nlo, constant_like(a.nlo, -lo));
    part.empty = part.empty || !inside(-a.hi, lo);
    part.continuous = part.continuous && inside(a.nlo, lo);
  }
  if (hi < infinity) {
    part.hi = min(a.hi, constant_like(a.hi, hi));
    part.empty = part.empty || !inside(a.lo(), -hi);
    part.continuous = part.continuous && inside(a.hi, -hi);
  }
  return part;
}

Interval increasing(Op op, const Interval& a, Facts facts, double limit = infinity) {
  Expr nlo = bounds_at(op, {a.lo()}).minus_below, hi = bounds_at(op, {a.hi}).above;
  if (limit < infinity) nlo = at_most(nlo, limit), hi = at_most(hi, limit);
  if (facts.nonnegative) nlo = at_most(nlo, 0);
  return {nlo, hi, a.empty, a.continuous, facts};
}

// Of an odd function, whose sign is that of its operand.
Facts odd(const Interval& a, bool bounded) { return {a.facts.nonnegative, bounded}; }

// a / (turn pi), for a power of two `turn`.
Interval in_turns(const IntervalRules& rules, const Interval& a, double turn) {
  const auto end = [&](double value) { return rounded_up(*a.hi.graph, a.hi.type(), value); };
  return rules.mul(a, interval(end(-below_inverse_pi / turn), end(above_inverse_pi / turn), {true, true}));
}

// Whether t + shift may be an integer for a t in the interval.
Truth may_be_integer(const Interval& t, double shift) {
  const Expr hi = add_up(t.hi, constant_like(t.hi, shift)), nlo = add_up(t.nlo, constant_like(t.hi, -shift));
  return !(floor(hi) + floor(nlo) < 0);
}

Truth too_far(const Interval& a) { return !(max(a.nlo, a.hi) <= elementary::largest_angle(a.hi.type())); }

// sin or cos: maximal where x/(2 pi) + shift is an integer, and minimal half a turn from there.
Interval wave(const IntervalRules& rules, Op op, const Interval& a, double shift) {
  const Interval turns = in_turns(rules, a, 2);
  const Bounds from = bounds_at(op, {a.lo()}), to = bounds_at(op, {a.hi});
  const auto end = [&](Truth extreme, Expr p, Expr q) {
    return select(extreme || too_far(a), one(p), at_most(max(p, q), 1));
  };
  return {end(may_be_integer(turns, shift + 0.5), from.minus_below, to.minus_below),
          end(may_be_integer(turns, shift), from.above, to.above),
          a.empty,
          a.continuous,
          {false, true}};
}

}  // namespace

Interval IntervalRules::exp(const Interval& a) const { return increasing(Op::exp, a, {true, false}); }
Interval IntervalRules::sinh(const Interval& a) const { return increasing(Op::sinh, a, odd(a, false)); }
Interval IntervalRules::tanh(const Interval& a) const { return increasing(Op::tanh, a, odd(a, true), 1); }
Interval IntervalRules::asinh(const Interval& a) const {
  return increasing(Op::asinh, a, odd(a, a.facts.bounded));
}
Interval IntervalRules::cbrt(const Interval& a) const {
  return increasing(Op::cbrt, a, odd(a, a.facts.bounded));
}
Interval IntervalRules::atan(const Interval& a) const {
  return increasing(Op::atan, a, odd(a, true), above_pi / 2);
}

Interval IntervalRules::log(const Interval& a) const {
  return increasing(Op::log, in_domain(a, 0, infinity, Edges::open), {});
}
Interval IntervalRules::acosh(const Interval& a) const {
  return increasing(Op::acosh, in_domain(a, 1, infinity), {true, a.facts.bounded});
}
Interval IntervalRules::atanh(const Interval& a) const {
  return increasing(Op::atanh, in_domain(a, -1, 1, Edges::open), odd(a, false));
}
Interval IntervalRules::asin(const Interval& a) const {
  return increasing(Op::asin, in_domain(a, -1, 1), odd(a, true), above_pi / 2);
}

Interval IntervalRules::acos(const Interval& a) const {
  const Interval part = in_domain(a, -1, 1);
  return {at_most(bounds_at(Op::acos, {part.hi}).minus_below, 0),
          at_most(bounds_at(Op::acos, {part.lo()}).above, above_pi),
          part.empty,
          part.continuous,
          {true, true}};
}

Interval IntervalRules::cosh(const Interval& a) const { return increasing(Op::cosh, abs(a), {true, false}); }

Interval IntervalRules::sin(const Interval& a) const { return wave(*this, Op::sin, a, -0.25); }
Interval IntervalRules::cos(const Interval& a) const { return wave(*this, Op::cos, a, 0); }

Interval IntervalRules::tan(const Interval& a) const {
  const Truth pole = may_be_integer(in_turns(*this, a, 1), 0.5) || too_far(a);
  const Expr all = constant_like(a.hi, infinity);
  const Interval between = increasing(Op::tan, a, {});
  return {imp::select(pole, all, between.nlo),
          imp::select(pole, all, between.hi),
          a.empty,
          a.continuous && !pole,
          {}};
}

// x^y is monotone in each, the other way round beyond 1 and beyond 0: the extremes lie at corners.
Interval IntervalRules::pow(const Interval& a, const Interval& b) const {
  const Interval x = in_domain(a, 0, infinity);
  const Expr none = zero(a.hi);
  const auto highest = [&](Expr base) {
    return bounds_at(Op::pow, {base, imp::select(base > 1, b.hi, b.lo())}).above;
  };
  const auto lowest = [&](Expr base) {
    return bounds_at(Op::pow, {base, imp::select(base > 1, b.lo(), b.hi)}).minus_below;
  };
  const bool rises = b.facts.nonnegative;
  const Expr nlo = rises ? lowest(x.lo()) : imp::max(lowest(x.lo()), lowest(x.hi));
  const Expr hi = rises ? highest(x.hi) : imp::max(highest(x.lo()), highest(x.hi));
  return {at_most(nlo, 0),
          hi,
          x.empty || b.empty || (x.hi <= none && b.hi < none),
          x.continuous && b.continuous && (x.nlo < none || b.nlo < none),
          {true, false}};
}

// The angle of the point (x, y): it grows with y to the right of the y axis and falls with x above the
// x axis, so its extremes over a box without the origin lie at two corners. Left of the origin the angle
// jumps from pi to -pi.
Interval IntervalRules::atan2(const Interval& y, const Interval& x) const {
  const Expr none = zero(x.hi), pi = rounded_up(*x.hi.graph, x.hi.type(), above_pi);
  const Truth upper = y.nlo <= none, lower = y.hi < none, right = x.nlo < none;
  // Where no y is negative none is -0 either, which lies on the other side of the cut.
  const Expr ylo = imp::select(upper, imp::max(y.lo(), none), y.lo());
  const Expr yhi = imp::select(upper, imp::max(y.hi, none), y.hi);
  const Expr far = imp::select(lower, x.hi, x.lo()), near = imp::select(upper, x.hi, x.lo());
  const Bounds last = bounds_at(Op::atan2, {imp::select(far > none, yhi, ylo), far});
  const Bounds first = bounds_at(Op::atan2, {imp::select(near > none, ylo, yhi), near});
  const Truth origin = !right && y.nlo >= none && y.hi >= none && x.hi >= none;
  const Truth cut = !right && !upper && !lower;
  const Truth around = origin || cut;
  // Where y is 0 left of the origin its sign would tell pi from -pi, and a driver need not keep it.
  const Truth half_turn = !right && equal(ylo, none);
  // Above the x axis no angle is negative, not even around the origin.
  const Expr below = imp::select(upper, none, pi);
  return {imp::select(around, below, at_most(first.minus_below, above_pi)),
          imp::select(around || half_turn, pi, at_most(last.above, above_pi)),
          x.empty || y.empty,
          x.continuous && y.continuous && !around,
          {false, true}};
}

}  // namespace imp
