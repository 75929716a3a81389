// The affine rules of non-affine functions. Each finds a slope k, any number, and encloses f(u) - k u over the
// range of the operand: f is k u plus that (Fryazinov, Pasko and Comninos 2010). Where the sign of f" is known the
// line is Chebyshev's or near it: the extremes lie at the ends and where f' = k.
#include <algorithm>
#include <cmath>
#include <functional>

#include "ir/infinity.h"
#include "passes/elementary/bounds.h"
#include "passes/extend/affine_lines.h"
#include "passes/extend/affine_rules.h"

namespace imp {
namespace {

using Value = AffineRules::Value;
using affine::Ends;

double size(const Range& range) { return std::max(std::abs(range.lo), std::abs(range.hi)); }

// `a` where `c` holds; else no form.
Affine where(Truth c, Affine a) {
  const Expr none = constant_like(a.c, infinity);
  a.e = {select(c, a.e.nlo, none), select(c, a.e.hi, none)};
  return a;
}

bool always(Truth c) { return c.graph->truth_value(c.id) == true; }

Expr above(Op op, Expr at) { return elementary::above(op, make(op, at)); }
Expr minus_below(Op op, Expr at) { return elementary::minus_below(op, make(op, at)); }

// Of a line of at most this slope, the limit of what is computed; none where the slope itself may overflow.
double limited(double steepest, double reach, Type type) {
  return steepest < affine::safe(type) ? 4 * steepest * reach : infinity;
}

// A number in the interval, about its middle; and how far the ends are from there.
Expr middle(const Interval& a) { return max(min(0.5 * (a.hi - a.nlo), a.hi), a.lo()); }
Expr reach(const Interval& a, Expr p) { return max(add_up(a.hi, -p), add_up(a.nlo, p)); }

// The slope of |u| from end to end, in [-1, 1].
Expr chord(const Interval& u) {
  const Expr slope = (u.hi - u.nlo) / (u.hi + u.nlo), unit = one(slope);
  const Expr within = max(-unit, min(unit, slope));
  return select(u.nlo <= 0, unit, select(u.hi <= 0, -unit, within));
}

}  // namespace

// 1/u is odd, so a negative u is turned around.
Affine AffineRules::reciprocal(const Value& b) const {
  const Interval& u = b.range;
  const Expr none = zero(u.hi);
  const Truth turned = u.facts.nonnegative ? truth_of(*u.hi.graph, false) : u.hi < none;
  const Expr near = imp::select(turned, -u.hi, u.lo()), far = imp::select(turned, u.nlo, u.hi);
  const auto [k, upright] = affine::reciprocal_line(near, far);
  const Ends rest{imp::select(turned, upright.hi, upright.nlo), imp::select(turned, upright.nlo, upright.hi)};

  const double nearest = b.known.lo > 0 ? b.known.lo : b.known.hi < 0 ? -b.known.hi : 0;
  const double limit = limited(1 / (nearest * nearest), b.form->limit + size(b.known) + nearest, k.type());
  return where(near > none, affine::line(*b.form, k, rest, limit));
}

// Below 0 there are no values to hold.
Value AffineRules::sqrt(const Value& a) const {
  const Expr none = zero(a.range.hi), lo = imp::max(a.range.lo(), none);
  const Expr hi = a.range.facts.nonnegative ? a.range.hi : imp::max(a.range.hi, none);
  const auto [k, rest] = affine::root_line(lo, hi);
  const double steepest = a.known.lo > 0 ? 0.5 / std::sqrt(a.known.lo) : infinity;
  const double limit = 4 * (steepest * (a.form->limit + size(a.known)) + std::sqrt(size(a.known)));
  return {where(hi > none, affine::line(*a.form, k, rest, limit)), rules_.sqrt(a), true};
}

// With k near exp(p): exp(u) - k u is largest at an end, and never below the tangent at p, exp(p) (1 + u - p) - k u
// = k (1 - p) + (exp(p) - k)(1 + u - p).
Value AffineRules::exp(const Value& a) const {
  const Interval& u = a.range;
  const Expr p = middle(u), k = make(Op::exp, p);
  const Expr off =
      imp::max(add_up(elementary::above(Op::exp, k), -k), add_up(elementary::minus_below(Op::exp, k), k));
  const Ends rest{add_up(mul_up(off, add_up(reach(u, p), one(p))), fma_up(k, p, -k)),
                  imp::max(fma_up(k, u.nlo, above(Op::exp, u.lo())), fma_up(-k, u.hi, above(Op::exp, u.hi)))};
  const double limit = 4 * std::exp(a.known.hi) * (a.form->limit + size(a.known) + 1);
  return {affine::line(*a.form, k, rest, std::isnan(limit) ? infinity : limit), rules_.exp(a), true};
}

// log(u) - k u is never above -log(k) - 1, and smallest at an end.
Value AffineRules::log(const Value& a) const {
  const Interval& u = a.range;
  const Expr lo = u.lo(), k = 1.0 / middle(u);
  const Ends rest{
      imp::max(fma_up(k, lo, minus_below(Op::log, lo)), fma_up(k, u.hi, minus_below(Op::log, u.hi))),
      add_up(minus_below(Op::log, k), constant_like(k, -1))};
  const double steepest = a.known.lo > 0 ? 1 / a.known.lo : infinity;
  const double logarithms = 2 + std::abs(std::log(a.known.lo)) + std::abs(std::log(a.known.hi));
  const double limit = limited(steepest, a.form->limit + size(a.known) + logarithms / steepest, k.type());
  return {where(lo > zero(lo), affine::line(*a.form, k, rest, limit)), rules_.log(a), true};
}

// sin(c + t) = sin(c) cos(t) + cos(c) sin(t) for |t| <= R: cos(t) lies in [1 - 2 q, 1] with q >= R²/4, and sin(t)
// within R³/6 of t. `at` is the function at c, `ahead` times `sign` a quarter turn on.
//
// Roundings, with R < 2: the two values are off by n eps each, as stated in elementary/bounds.h, and at most 1;
// c' three roundings of at most 1, each x' one, of at most R in all: 6 eps. Beyond, and where the angle is too large,
// it is [-1, 1].
Affine AffineRules::wave(const Affine& angle, Op at, Op ahead, double sign) const {
  const Type type = angle.c.type();
  const double eps = affine::eps(type), off = *elementary::ulps(at, type) + *elementary::ulps(ahead, type);
  const Expr r = affine::radius(angle), rr = mul_up(r, r), q = mul_up(rr, constant_like(r, 0.25));
  const Expr value = make(at, angle.c), slope = make(ahead, angle.c) * sign;
  const Expr rrr = mul_up(rr, r), sixth = rounded_up(*r.graph, type, 1.0 / 6 * (1 + 0x1p-50));
  const Ends cubic{fma_up(rrr, sixth, angle.e.nlo), fma_up(rrr, sixth, angle.e.hi)};
  const Ends roundings = affine::both(constant_like(r, (off + 7) * eps));
  Affine result = affine::constant(r, shape_, 0, 1), unit = result;
  result.c = imp::fma(-value, q, value);
  result.e = affine::plus_product(roundings, value, affine::both(q));
  result.e = affine::plus_product(result.e, slope, cubic);
  for (std::size_t i = 0; i < shape_.symbols; ++i)
    if (r.graph->number(angle.x[i].id) != 0.0) result.x[i] = slope * angle.x[i];
  result.limit = 8;
  const Truth near = r < 2 && imp::abs(angle.c) <= elementary::largest_angle(type);
  return affine::select(near, result, unit);
}

Value AffineRules::sin(const Value& a) const {
  Value result{wave(*a.form, Op::sin, Op::cos, 1), rules_.sin(a)};
  result.known = {-1, 1};
  return result;
}

Value AffineRules::cos(const Value& a) const {
  Value result{wave(*a.form, Op::cos, Op::sin, -1), rules_.cos(a)};
  result.known = {-1, 1};
  return result;
}

// |u| - k u for k in [-1, 1] is never below 0, and largest at an end.
Value AffineRules::abs(const Value& a) const {
  const Interval range = rules_.abs(a), &u = a.range;
  if (u.facts.nonnegative) return {a.form, range, true};
  const Expr k = chord(u), none = zero(k);
  const Expr top =
      imp::max(imp::max(mul_up(u.hi, add_up(one(k), -k)), mul_up(u.nlo, add_up(one(k), k))), none);
  return {affine::line(*a.form, k, {none, top}, 5 * (a.form->limit + size(a.known))), range, true};
}

// max(a, b) = k a + (1 - k) b + r with r = max(d, 0) - k d for d = a - b: r is never below 0, and largest at an end of
// d. With k of 12 bits 1 - k is exact. Where a may be undefined the answer may be b (ir/ops.def), or a.
Value AffineRules::max(const Value& a, const Value& b) const {
  const Interval range = rules_.max(a, b);
  if (!always(a.range.continuous)) return only(range);
  const Value difference = settled(sub(a, b));
  const Interval& d = difference.range;
  const Expr k = imp::floor((chord(d) + 1.0) * 2048.0) * 0x1p-12, rest = 1.0 - k, none = zero(k);
  const Expr top = imp::max(imp::max(mul_up(rest, d.hi), mul_up(k, d.nlo)), none);
  const double limit = 4 * (a.form->limit + b.form->limit);
  return {affine::add(affine::line(*a.form, k, {none, top}, limit),
                      affine::line(*b.form, rest, {none, none}, limit)),
          range, true};
}

Value AffineRules::min(const Value& a, const Value& b) const {
  const Value turned = max(settled(neg(a)), settled(neg(b)));
  return {turned.form ? std::optional(affine::neg(*turned.form)) : std::nullopt, rules_.min(a, b), true};
}

// By the mean value theorem f(u) - k u lies within |f' - k| |u - p| of f(p) - k p, for f' over the range, where f
// is continuous.
Value AffineRules::sloped(const Value& a, const Function& f, const Interval& slope) const {
  Interval u = a.range;
  u.empty = truth_of(*u.hi.graph, false);
  u.continuous = truth_of(*u.hi.graph, true);
  const Expr p = middle(u), k = 0.5 * (slope.hi - slope.nlo);
  const Interval at = f(point(p));
  const Expr around = mul_up(reach(slope, k), reach(u, p));
  const Ends rest{add_up(fma_up(k, p, at.nlo), around), add_up(fma_up(-k, p, at.hi), around)};
  return {where(f(u).continuous && !slope.empty, affine::line(*a.form, k, rest, infinity)), f(a), true};
}

namespace {

const IntervalRules on;
Interval unit(const Interval& like) { return point(one(like.hi), {true, true}); }
Interval inverse(const Interval& a) { return on.div(unit(a), a); }
Interval plus_one(const Interval& a) { return on.add(a, unit(a)); }
Interval less_one(const Interval& a) { return on.sub(a, unit(a)); }
Interval from_one(const Interval& a) { return on.sub(unit(a), a); }

}  // namespace

#define IMP_SLOPED(function, derivative)                                            \
  Value AffineRules::function(const Value& a) const {                               \
    const Interval& u = a.range;                                                    \
    return sloped(a, [](const Interval& v) { return on.function(v); }, derivative); \
  }
IMP_SLOPED(cbrt, inverse(on.mul(on.square(on.cbrt(u)), point(constant_like(u.hi, 3)))))
IMP_SLOPED(tan, plus_one(on.square(on.tan(u))))
IMP_SLOPED(asin, inverse(on.sqrt(from_one(on.square(u)))))
IMP_SLOPED(acos, on.neg(inverse(on.sqrt(from_one(on.square(u))))))
IMP_SLOPED(atan, inverse(plus_one(on.square(u))))
IMP_SLOPED(sinh, on.cosh(u))
IMP_SLOPED(cosh, on.sinh(u))
IMP_SLOPED(tanh, from_one(on.square(on.tanh(u))))
IMP_SLOPED(asinh, inverse(on.sqrt(plus_one(on.square(u)))))
IMP_SLOPED(acosh, inverse(on.sqrt(less_one(on.square(u)))))
IMP_SLOPED(atanh, inverse(from_one(on.square(u))))
#undef IMP_SLOPED

// Of a constant exponent.
Value AffineRules::pow(const Value& a, const Value& b) const {
  if (b.range.hi.graph->number(b.range.hi.id) && b.range.hi.graph->number(b.range.nlo.id))
    return sloped(
        a, [&](const Interval& v) { return rules_.pow(v, b); }, rules_.mul(b, rules_.pow(a, less_one(b))));
  return only(rules_.pow(a, b));
}

Value AffineRules::chebyshev(const Value& a, const Value& degree, const Value& order) const {
  const Graph& graph = *a.range.hi.graph;
  const auto n = graph.number(degree.range.hi.id), k = graph.number(order.range.hi.id);
  if (!n || !k || *k >= *n) return only(rules_.chebyshev(a, degree, order));
  const Interval next = point(constant_like(a.range.hi, *k + 1), {true, true});
  return sloped(
      a, [&](const Interval& v) { return rules_.chebyshev(v, degree, order); },
      rules_.chebyshev(a, degree, next));
}

}  // namespace imp
