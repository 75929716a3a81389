#include "passes/extend/interval_rules.h"

#include <cmath>

#include "ir/addition_chain.h"
#include "ir/assert.h"
#include "ir/infinity.h"

namespace imp {
namespace {

// An interval of known flags; the facts that do not depend on the bounds of others.
Interval with(const Interval& like, Expr nlo, Expr hi, Facts facts = {}) {
  return {nlo, hi, like.empty, like.continuous, facts};
}

Interval strict(const Interval& a, const Interval& b, Expr nlo, Expr hi, Facts facts = {}) {
  return {nlo, hi, a.empty || b.empty, a.continuous && b.continuous, facts};
}

// Of a step function, continuous where it takes one value.
Interval stepped(const Interval& a, Expr nlo, Expr hi, Facts facts) {
  return {nlo, hi, a.empty, a.continuous && equal(-nlo, hi), facts};
}

// The value where the interval is one constant point, and is one on every box.
std::optional<double> constant_point(const Interval& a) {
  const Graph& graph = *a.hi.graph;
  const auto nlo = graph.number(a.nlo.id), hi = graph.number(a.hi.id);
  const bool always = graph.truth_value(a.continuous.id) == true && graph.truth_value(a.empty.id) == false;
  return always && nlo && hi && -*nlo == *hi ? hi : std::nullopt;
}

bool nonpositive(const Interval& a) {
  const auto hi = a.hi.graph->number(a.hi.id);
  return hi && *hi <= 0;
}

// 0 * inf is 0 as a product of sets; a NaN among the products stands for it.
Expr zero_if_nan(Expr product) { return select(equal(product, product), product, zero(product)); }

// The largest of products of which any may be NaN for 0 * inf. max drops a NaN on its left.
Expr largest(std::initializer_list<Expr> products, bool bounded) {
  auto it = products.end();
  Expr result = *--it;
  if (!bounded) result = zero_if_nan(result);
  while (it != products.begin()) result = max(*--it, result);
  return result;
}

// The largest and the smallest magnitude in the interval.
Expr magnitude(const Interval& a) { return a.facts.nonnegative ? a.hi : max(a.nlo, a.hi); }
Expr mignitude(const Interval& a) {
  if (a.facts.nonnegative) return a.lo();
  return max(max(a.lo(), -a.hi), zero(a.hi));
}

// r, or a power of two above it where it is so small that its powers would be denormal: those cost
// up to fifty times as much. Never below r, so the rounding stays upward.
Expr out_of_denormals(Expr r) {
  const double tiny = r.type() == f32 ? 0x1p-62 : 0x1p-510;
  return select(abs(r) < tiny, select(r > 0, constant_like(r, tiny), zero(r)), r);
}

enum class Sign : std::int8_t { unknown, positive, negative };  // positive: >= 0, negative: <= 0

Expr magnitude(Expr r, Sign sign) {
  return sign == Sign::positive ? r : sign == Sign::negative ? -r : abs(r);
}

// sign(x) |x|^n, rounded upward. With r of sign s, r * |x|^k rounds upward if r and s|x|^k do: for
// x > 0 all factors are too large, for x < 0 all magnitudes too small.
Expr signed_power_up(Expr x, unsigned n, Sign sign) {
  const bool may_underflow = n >= 16;
  const auto tame = [&](Expr r) { return may_underflow && !(r == x) ? out_of_denormals(r) : r; };
  return positive_power(
      x, n, [&](Expr left, Expr right) { return mul_up(tame(left), magnitude(tame(right), sign)); });
}

Interval power(const Interval& a, unsigned n) {
  if (n % 2 == 0)
    return with(a, signed_power_up(-mignitude(a), n, Sign::negative),
                signed_power_up(magnitude(a), n, Sign::positive), {true, false});
  const bool positive = a.facts.nonnegative;
  return with(a, signed_power_up(a.nlo, n, positive ? Sign::negative : Sign::unknown),
              signed_power_up(a.hi, n, positive ? Sign::positive : Sign::unknown), {positive, false});
}

Interval scaled(const Interval& a, double c) {
  if (c == 0) return with(a, zero(a.hi), zero(a.hi), {true, true});
  const Expr factor = constant_like(a.hi, std::abs(c));
  const Expr up = mul_up(a.hi, factor), down = mul_up(a.nlo, factor);
  return c > 0 ? with(a, down, up, {a.facts.nonnegative, false}) : with(a, up, down);
}

// Ends that say nothing of a set that is not empty.
Truth unknown(const Interval& a) { return !(a.empty || is_ordered(a)); }

}  // namespace

Interval interval(Expr nlo, Expr hi, Facts facts) {
  return {nlo, hi, truth_of(*hi.graph, false), truth_of(*hi.graph, true), facts};
}

Interval point(Expr value, Facts facts) { return interval(-value, value, facts); }

Interval intersect(const Interval& a, const Interval& b) {
  const Expr nlo = min(a.nlo, b.nlo), hi = min(a.hi, b.hi);
  return {nlo,
          hi,
          a.empty || b.empty || (is_ordered(a) && is_ordered(b) && hi < -nlo),
          a.continuous || b.continuous,
          {a.facts.nonnegative || b.facts.nonnegative, a.facts.bounded || b.facts.bounded}};
}

Interval IntervalRules::add(const Interval& a, const Interval& b) const {
  return strict(a, b, add_up(a.nlo, b.nlo), add_up(a.hi, b.hi),
                {a.facts.nonnegative && b.facts.nonnegative, false});
}

Interval IntervalRules::sub(const Interval& a, const Interval& b) const {
  return strict(a, b, add_up(a.nlo, b.hi), add_up(a.hi, b.nlo),
                {a.facts.nonnegative && nonpositive(b), false});
}

Interval IntervalRules::neg(const Interval& a) const {
  return with(a, a.hi, a.nlo, {nonpositive(a), a.facts.bounded});
}

Interval IntervalRules::mul(const Interval& a, const Interval& b) const {
  if (const auto c = constant_point(b)) return scaled(a, *c);
  if (constant_point(a)) return mul(b, a);
  if (nonpositive(b) && !b.facts.nonnegative) return neg(mul(a, neg(b)));
  if (nonpositive(a) && !a.facts.nonnegative) return neg(mul(neg(a), b));
  if (a.facts.nonnegative && !b.facts.nonnegative) return mul(b, a);

  const bool bounded = a.facts.bounded && b.facts.bounded;
  const Expr alo = a.lo(), blo = b.lo();
  if (a.facts.nonnegative) {
    const Expr hi = mul_up(a.hi, b.hi);
    return strict(a, b, mul_up(a.nlo, blo), bounded ? hi : zero_if_nan(hi), {true, false});
  }
  if (b.facts.nonnegative)
    return strict(a, b, largest({mul_up(a.nlo, b.hi), mul_up(a.nlo, blo)}, bounded),
                  largest({mul_up(a.hi, b.hi), mul_up(a.hi, blo)}, bounded));
  return strict(
      a, b,
      largest({mul_up(a.nlo, b.hi), mul_up(a.hi, b.nlo), mul_up(a.nlo, blo), mul_up(-a.hi, b.hi)}, bounded),
      largest({mul_up(a.hi, b.hi), mul_up(a.nlo, b.nlo), mul_up(alo, b.hi), mul_up(a.hi, blo)}, bounded));
}

Interval IntervalRules::square(const Interval& a) const { return power(a, 2); }

Interval IntervalRules::fma(const Interval& a, const Interval& b, const Interval& c) const {
  return add(mul(a, b), c);
}

// For 0 < b the ends are a.hi / (b.lo or b.hi) by the sign of a.hi, and alike for a.lo. A negative
// b is turned around together with a; across 0 the quotient is everything, but for 0 / b. A divisor 0 is +0,
// or the sign of it does not count (backends/glsl/prelude.h).
Interval IntervalRules::div(const Interval& a, const Interval& b) const {
  if (const auto c = constant_point(b); c && *c != 0) {
    const Expr divisor = constant_like(a.hi, std::abs(*c));
    const Expr up = div_up(a.hi, divisor), down = div_up(a.nlo, divisor);
    return *c > 0 ? with(a, down, up, {a.facts.nonnegative, false}) : with(a, up, down);
  }
  const Expr none = zero(b.hi);
  const Truth turned = b.facts.nonnegative ? truth_of(*b.hi.graph, false) : b.hi <= 0;
  const Expr nlo = imp::select(turned, a.hi, a.nlo), hi = imp::select(turned, a.nlo, a.hi);
  const Expr near = imp::max(imp::select(turned, -b.hi, b.lo()), none);  // the smaller |b|, never -0
  const Expr far = imp::select(turned, b.nlo, b.hi);
  const auto quotient = [&](Expr end) {
    return imp::select(equal(end, none), none, div_up(end, imp::select(end < none, far, near)));
  };
  const Truth across = b.nlo > 0 && b.hi > 0;
  const Truth entire = across && !(equal(a.nlo, none) && equal(a.hi, none));
  const Truth only_zero = equal(b.nlo, none) && equal(b.hi, none);
  const Expr all_reals = constant_like(b.hi, infinity);
  return {imp::select(entire, all_reals, quotient(nlo)),
          imp::select(entire, all_reals, quotient(hi)),
          a.empty || b.empty || only_zero,
          a.continuous && b.continuous && (b.nlo < none || b.hi < none),
          {a.facts.nonnegative && b.facts.nonnegative, false}};
}

Interval IntervalRules::abs(const Interval& a) const {
  return with(a, -mignitude(a), magnitude(a), {true, a.facts.bounded});
}

// min and max answer b where a is NaN (ir/ops.def), so where a may be undefined the answer may be b.
Interval IntervalRules::or_second(const Interval& a, const Interval& b, const Interval& strict_result) const {
  const Truth undefined = !a.continuous;
  const auto either = [&](Expr both, Expr second) {
    return imp::select(a.empty, second, imp::select(undefined, imp::max(both, second), both));
  };
  Interval result = strict_result;
  result.nlo = either(strict_result.nlo, b.nlo);
  result.hi = either(strict_result.hi, b.hi);
  result.empty = b.empty;
  const bool always = undefined.graph->truth_value(undefined.id) == false;
  result.facts.nonnegative = strict_result.facts.nonnegative && (always || b.facts.nonnegative);
  return result;
}

Interval IntervalRules::min(const Interval& a, const Interval& b) const {
  return or_second(a, b,
                   strict(a, b, imp::max(a.nlo, b.nlo), imp::min(a.hi, b.hi),
                          {a.facts.nonnegative && b.facts.nonnegative, a.facts.bounded && b.facts.bounded}));
}

Interval IntervalRules::max(const Interval& a, const Interval& b) const {
  return or_second(a, b,
                   strict(a, b, imp::min(a.nlo, b.nlo), imp::max(a.hi, b.hi),
                          {a.facts.nonnegative || b.facts.nonnegative, a.facts.bounded && b.facts.bounded}));
}

// Downward, sqrt(lo) is lo / sqrt_up(lo): there are no downward ops.
Interval IntervalRules::sqrt(const Interval& a) const {
  const Expr lo = a.lo(), none = zero(lo);
  const Expr root = div_up(a.nlo, sqrt_up(lo));
  const bool defined = a.facts.nonnegative;
  return {imp::select(lo > none, root, none),
          sqrt_up(defined ? a.hi : imp::max(a.hi, none)),
          defined ? a.empty : a.empty || a.hi < none,
          defined ? a.continuous : a.continuous && lo >= none,
          {true, a.facts.bounded}};
}

Interval IntervalRules::floor(const Interval& a) const {
  return stepped(a, imp::ceil(a.nlo), imp::floor(a.hi), a.facts);
}

Interval IntervalRules::ceil(const Interval& a) const {
  return stepped(a, imp::floor(a.nlo), imp::ceil(a.hi), a.facts);
}

Interval IntervalRules::sign(const Interval& a) const {
  return stepped(a, make(Op::sign, a.nlo), make(Op::sign, a.hi), {a.facts.nonnegative, true});
}

Interval IntervalRules::mod(const Interval& a, const Interval& b) const {
  return sub(a, mul(b, floor(div(a, b))));
}

Interval IntervalRules::powi(const Interval& a, const Interval& exponent) const {
  const auto n = constant_point(exponent);
  IMP_ASSERT(n.has_value(), "a constant exponent");
  if (*n == 0) return with(a, -one(a.hi), one(a.hi), {true, true});
  const Interval positive = power(a, static_cast<unsigned>(std::abs(*n)));
  return *n > 0 ? positive : div(point(one(a.hi), {true, true}), positive);
}

Possible IntervalRules::lt(const Interval& a, const Interval& b) const {
  const Truth undefined = !(a.continuous && b.continuous);  // NaN compares false
  const Truth either = unknown(a) || unknown(b);
  return {a.lo() < b.hi || either, a.hi >= b.lo() || undefined || either};
}

Possible IntervalRules::le(const Interval& a, const Interval& b) const {
  const Truth undefined = !(a.continuous && b.continuous);
  const Truth either = unknown(a) || unknown(b);
  return {a.lo() <= b.hi || either, a.hi > b.lo() || undefined || either};
}

Possible IntervalRules::eq(const Interval& a, const Interval& b) const {
  const Truth undefined = !(a.continuous && b.continuous);
  const Truth either = unknown(a) || unknown(b);
  return {(a.lo() <= b.hi && b.lo() <= a.hi) || either,
          a.lo() < b.hi || b.lo() < a.hi || undefined || either};
}

Possible IntervalRules::and_(const Possible& a, const Possible& b) const {
  return {a.yes && b.yes, a.no || b.no};
}

Possible IntervalRules::or_(const Possible& a, const Possible& b) const {
  return {a.yes || b.yes, a.no && b.no};
}

Possible IntervalRules::not_(const Possible& a) const { return {a.no, a.yes}; }

// The hull of the branches that may be taken. Where both may, nothing says that they meet.
Interval IntervalRules::select(const Possible& c, const Interval& a, const Interval& b) const {
  const Expr nothing = constant_like(a.hi, -infinity);
  const Truth from_a = c.yes && !a.empty, from_b = c.no && !b.empty;
  const auto hull = [&](Expr p, Expr q) {
    return imp::max(imp::select(from_a, p, nothing), imp::select(from_b, q, nothing));
  };
  return {hull(a.nlo, b.nlo),
          hull(a.hi, b.hi),
          !from_a && !from_b,
          imp::select(c.yes, !c.no && a.continuous, b.continuous),
          {a.facts.nonnegative && b.facts.nonnegative, a.facts.bounded && b.facts.bounded}};
}

}  // namespace imp
