#include "passes/extend/affine.h"

#include <algorithm>
#include <cmath>

#include "ir/infinity.h"

namespace imp::affine {
namespace {

// Added to the error of all but exact constants, at no cost where a fused addend is free: it pays for so many
// results that a driver flushes, each at most the smallest normal number.
constexpr int flushes = 1 << 20;
double reserve(Type type) { return flushes * smallest_normal(type); }

// The part 0 stays out of it: no form drops out by that, as its other parts tell (see `mul`).
Expr product(Expr a, Expr b) { return is_zero(a) ? a : is_zero(b) ? b : a * b; }
Expr sum_of_product(Expr a, Expr b, Expr c) {
  if (is_zero(a) || is_zero(b)) return c;
  return is_zero(c) ? a * b : imp::fma(a, b, c);
}

// What may have overflowed is never bounded again.
double limit_or_none(Type type, double limit) { return limit < safe(type) ? limit : infinity; }
// What limits grow by in a rule, all roundings included.
double grown(Type type, double limit) { return limit_or_none(type, 1.001 * limit + 1e-20); }

Expr plus_linear(Expr sum, const Affine& a) {
  for (const Expr x : a.x) sum = add_up(sum, abs(x));
  return sum;
}
Expr linear(const Affine& a) { return plus_linear(zero(a.c), a); }  // Σ|xi|
Expr size(const Affine& a) { return plus_linear(abs(a.c), a); }     // |c| + Σ|xi|
std::size_t parts(const Affine& a) { return a.x.size() + 1; }

// Pays for `count` flushed results.
void pay(Affine& a, std::size_t count) {
  a.spare -= static_cast<int>(count);
  if (a.spare >= 0) return;
  a.e = plus(a.e, both(constant_like(a.c, reserve(a.c.type()))));
  a.spare += flushes;
}

// Charges `roundings` eps of the sum `charged` of computed parts. Rounding upward, what overflows below becomes
// the largest number, not infinity: with e added, which is not 0, the sum makes an infinity of it, and so e.
void charge(Affine& a, double roundings, Expr charged) {
  if (is_zero(charged)) return;
  if (!is_bounded(a)) charged = add_up(charged, a.e.hi);
  a.e = plus_multiple(a.e, constant_like(charged, roundings * eps(charged.type())), both(charged));
}

// The one symbol on which both depend, where neither depends on another one.
std::optional<std::size_t> only_symbol(const Affine& a, const Affine& b) {
  std::optional<std::size_t> only;
  for (std::size_t i = 0; i < a.x.size(); ++i) {
    if (is_zero(a.x[i]) && is_zero(b.x[i])) continue;
    if (only || is_zero(a.x[i]) || is_zero(b.x[i])) return std::nullopt;
    only = i;
  }
  return only;
}

// Each part of the result is one op on those of a and b: eps of what is computed.
template <class Join>
Affine joined(const Affine& a, const Affine& b, const Ends& error_of_b, Join join) {
  Affine result{join(a.c, b.c),
                {},
                plus(a.e, error_of_b),
                grown(a.c.type(), a.limit + b.limit),
                std::min(a.spare, flushes) + std::min(b.spare, flushes),
                a.signed_errors};
  Expr charged = is_zero(a.c) || is_zero(b.c) ? zero(a.c) : abs(result.c);
  for (std::size_t i = 0; i < a.x.size(); ++i) {
    result.x.push_back(join(a.x[i], b.x[i]));
    if (!is_zero(a.x[i]) && !is_zero(b.x[i])) charged = add_up(charged, abs(result.x[i]));
  }
  charge(result, 1, charged);
  pay(result, parts(a));
  return result;
}

// sum + r1 r2 with ri = Li + Di, what depends on symbols and what does not (AF2). Of L1 L2 the product of the parts of
// one symbol is p ui², which lies between 0 and p; those of two symbols have either sign, as have L1 D2 and L2 D1.
Ends plus_deviations(Ends sum, const Affine& a, const Affine& b) {
  const Expr second = larger(b.e);
  Expr either = mul_up(linear(b), larger(a.e));
  for (std::size_t i = 0; i < a.x.size(); ++i) {
    if (is_zero(a.x[i])) continue;
    sum.nlo = max(sum_of_product_up(-a.x[i], b.x[i], sum.nlo), sum.nlo);
    sum.hi = max(sum_of_product_up(a.x[i], b.x[i], sum.hi), sum.hi);
    Expr others = second;
    for (std::size_t k = 0; k < b.x.size(); ++k)
      if (k != i) others = add_up(others, abs(b.x[k]));
    either = sum_of_product_up(abs(a.x[i]), others, either);
  }
  return plus_set_product(plus(sum, both(either)), a.e, b.e);
}

}  // namespace

double eps(Type type) { return type == f32 ? 0x1p-23 : 0x1p-52; }
double smallest_normal(Type type) { return type == f32 ? 0x1p-126 : 0x1p-1022; }
bool is_power_of_two(double value) {
  int exponent;
  return std::abs(std::frexp(value, &exponent)) == 0.5;
}
double safe(Type type) { return type == f32 ? 1e30 : 1e300; }
bool is_bounded(const Affine& a) { return a.limit < safe(a.c.type()); }

Affine constant(Expr like, const Shape& shape, double value, double error) {
  Affine result{constant_like(like, value),
                std::vector(shape.symbols, zero(like)),
                both(zero(like)),
                grown(like.type(), std::abs(value) + error),
                0,
                shape.signed_errors};
  if (error > 0) {
    result.e = both(rounded_up(*like.graph, like.type(), error + reserve(like.type())));
    result.spare = flushes - 1;
  }
  return result;
}

// With x not below the distance from c to either end, u = (v - c)/x lies in [-1, 1] for every v in it, whatever
// c is.
Affine of_interval(const Interval& a, const Shape& shape, std::optional<std::size_t> symbol, double limit) {
  const Expr none = zero(a.hi), spare = constant_like(a.hi, reserve(a.hi.type()));
  Affine result{a.hi,        std::vector(shape.symbols, none),
                both(spare), grown(a.hi.type(), limit),
                flushes - 1, shape.signed_errors};
  if ((-a.hi).id == a.nlo.id) return result;  // a point
  result.c = 0.5 * (a.hi - a.nlo);
  const Expr distance = max(add_up(a.hi, -result.c), add_up(a.nlo, result.c));
  if (symbol)
    result.x[*symbol] = distance;
  else
    result.e = both(add_up(distance, spare));
  return result;
}

Ends deviation(const Affine& a) { return plus(both(linear(a)), a.e); }
Expr radius(const Affine& a) { return larger(deviation(a)); }
Expr magnitude(const Affine& a) { return add_up(size(a), larger(a.e)); }
Truth is_form(const Affine& a) {
  return is_bounded(a) ? truth_of(*a.c.graph, true) : magnitude(a) < infinity;
}

Ends ends(const Affine& a) {
  const Ends r = deviation(a);
  return {add_up(r.nlo, -a.c), add_up(r.hi, a.c)};
}

Affine neg(const Affine& a) {
  Affine result = a;
  result.c = -a.c;
  result.e = turned(a.e);
  for (Expr& x : result.x) x = is_zero(x) ? x : -x;
  return result;
}

Affine add(const Affine& a, const Affine& b) {
  return joined(a, b, b.e, [](Expr p, Expr q) { return is_zero(p) ? q : is_zero(q) ? p : p + q; });
}

Affine sub(const Affine& a, const Affine& b) {
  return joined(a, b, turned(b.e), [](Expr p, Expr q) { return is_zero(q) ? p : is_zero(p) ? -q : p - q; });
}

// Eq. 15, last line. Where both depend on one and the same symbol only, the product of these parts is p u²,
// which lies within |p|/2 of p/2.
//
// Roundings: a part is a sum of at most two products, each rounded, and the sum: (2 eps + eps²) of the sum of
// their magnitudes. p/2 counts three times: as an addend, for the sum, and because |p|/2 stands for the exact
// one: 3/2 eps |p| in all. The magnitudes |c1 c2|, |c1 x2|, |c2 x1|, |p| are terms of M1 M2, where Mi is
// the magnitude of an operand, so 2.5 eps M1 M2 pays; and where a term overflows, M1 M2 is infinite. AF2 leaves p out
// of c, and so out of what is charged.
Affine mul(const Affine& a, const Affine& b) {
  const auto diagonal = only_symbol(a, b);
  const Type type = a.c.type();
  const Expr all = fma_up(magnitude(a), magnitude(b), constant_like(a.c, reserve(type) / eps(type)));
  Affine result{product(a.c, b.c),
                {},
                both(mul_up(all, constant_like(all, 2.5 * eps(type)))),
                grown(type, a.limit * b.limit),
                flushes - 3 * static_cast<int>(parts(a)),
                a.signed_errors};
  for (std::size_t i = 0; i < a.x.size(); ++i)
    result.x.push_back(sum_of_product(a.c, b.x[i], product(b.c, a.x[i])));
  if (diagonal && !a.signed_errors) {
    const Expr p = product(a.x[*diagonal], b.x[*diagonal]), half = constant_like(p, 0.5);
    result.c = sum_of_product(a.c, b.c, half * p);
    result.e = plus_multiple(result.e, half, both(abs(p)));
    result.e = plus_multiple(result.e, magnitude(a), b.e);
    result.e = plus_multiple(result.e, size(b), a.e);
  } else {
    result.e = a.signed_errors ? plus_deviations(result.e, a, b)
                               : plus_multiple(result.e, radius(a), both(radius(b)));
    result.e = plus_product(result.e, a.c, b.e);
    result.e = plus_product(result.e, b.c, a.e);
  }
  return result;
}

// With v = c + r, |r| <= R: v² = c² + 2 c r + r², and r² lies within h of any h >= R²/2; in AF2 it is an error that is
// not negative.
//
// Roundings: c² + h (2 eps + eps²) c² + eps h; each 2 c x eps; so 2.5 eps M² pays. In AF2 c² has one.
Affine square(const Affine& a) {
  const Type type = a.c.type();
  const Expr r = radius(a), m = magnitude(a);
  const Expr rr = mul_up(r, r), h = mul_up(constant_like(r, 0.5), rr), twice = 2.0 * a.c;
  const Expr all = fma_up(m, m, constant_like(m, reserve(type) / eps(type)));
  const Expr shift = a.signed_errors ? zero(h) : h;
  const Ends rest = a.signed_errors ? Ends{shift, rr} : both(h);
  Affine result{sum_of_product(a.c, a.c, shift),
                {},
                plus_multiple(rest, all, both(constant_like(all, 2.5 * eps(type)))),
                grown(type, a.limit * a.limit),
                flushes - 3 * static_cast<int>(parts(a)),
                a.signed_errors};
  for (const Expr x : a.x) result.x.push_back(product(twice, x));
  result.e = plus_product(result.e, twice, a.e);
  return result;
}

// v³ = c³ + 3 c² r + 3 c r² + r³, where 3 c r² lies within 3/2 |c| R² of 3/2 c R², and |r³| <= R³. In AF2 3 c r² has
// the sign of c, and of r³ each end is at most R² times that of r.
//
// Roundings: c (c² + 3/2 R²) four at most, 3 c² x three, 3 c² e one for c²; so 4 eps M³ pays. A flushed c² or
// R² counts |c|, 3 |x| or 3 e times: hence the reserve inside the product too. In AF2 c³ has two and 3 c one, for
// which 3 |c| R² is a term of M³; where 3 c is flushed that costs R² times as much, less than reserve M + eps M³.
Affine cube(const Affine& a) {
  const Type type = a.c.type();
  const Expr r = radius(a), m = magnitude(a), spare = constant_like(m, reserve(type) / eps(type));
  const Expr all = fma_up(m, fma_up(m, m, spare), spare);
  const Expr cc = a.c * a.c, rr = mul_up(r, r), slope = 3.0 * cc;
  Affine result{product(a.c, a.signed_errors ? cc : imp::fma(rr, constant_like(rr, 1.5), cc)),
                {},
                both(mul_up(all, constant_like(all, 4 * eps(type)))),
                grown(type, a.limit * a.limit * a.limit),
                flushes - 8 * static_cast<int>(parts(a)),
                a.signed_errors};
  for (const Expr x : a.x) result.x.push_back(product(slope, x));
  result.e = plus_multiple(result.e, slope, a.e);
  result.e = a.signed_errors ? plus_product(result.e, 3.0 * a.c, {zero(rr), rr})
                             : plus_multiple(result.e, rr, both(mul_up(constant_like(r, 1.5), abs(a.c))));
  result.e = plus_multiple(result.e, rr, deviation(a));
  return result;
}

// A power of two scales exactly. Else a part is off by eps of itself for the product, and by 2 eps of the exact
// one for a factor that is not exact: 3 eps and some eps² of itself; the factor of e is raised by more than that.
Affine scale(const Affine& a, double value, bool exact) {
  const bool power_of_two = exact && is_power_of_two(value);
  const Type type = a.c.type();
  const Expr factor = constant_like(a.c, value);
  const double grow = std::abs(value) * (exact ? 1 : 1 + 3 * eps(type));
  Affine result{product(a.c, factor),        {},      value < 0 ? turned(a.e) : a.e,
                grown(type, grow * a.limit), a.spare, a.signed_errors};
  for (const Expr x : a.x) result.x.push_back(product(x, factor));
  const bool shrinks = !power_of_two || std::abs(value) < 1;
  result.e = plus_multiple(both(constant_like(a.c, shrinks ? reserve(type) : 0)),
                           rounded_up(*a.c.graph, type, grow), result.e);
  if (shrinks) result.spare = flushes;
  if (!power_of_two || !is_bounded(result)) charge(result, exact ? 1 : 3.5, size(result));
  pay(result, 2 * parts(a));
  return result;
}

// Roundings: (2 eps + eps²) of |factor c| + |m| and eps of each |factor x|. A factor below the smallest normal
// number may be taken for 0: that costs as much for each of c and x.
Affine line(const Affine& a, Expr factor, const Ends& rest, double limit) {
  const Type type = a.c.type();
  const Expr m = 0.5 * (rest.hi - rest.nlo), steep = abs(factor);
  const Ends around = both(max(add_up(rest.nlo, m), add_up(rest.hi, -m)));
  const Expr steeper = add_up(steep, constant_like(steep, smallest_normal(type) / eps(type)));
  const Expr all = fma_up(steeper, size(a), add_up(abs(m), constant_like(m, reserve(type) / eps(type))));
  Affine result{
      sum_of_product(factor, a.c, m),
      {},
      plus_multiple(plus_product(around, factor, a.e), all, both(constant_like(all, 2.5 * eps(type)))),
      limit_or_none(type, limit),
      flushes - 3 * static_cast<int>(parts(a)),
      a.signed_errors};
  for (const Expr x : a.x) result.x.push_back(product(factor, x));
  return result;
}

Affine select(Truth c, const Affine& a, const Affine& b) {
  Affine result{imp::select(c, a.c, b.c),
                {},
                {imp::select(c, a.e.nlo, b.e.nlo), imp::select(c, a.e.hi, b.e.hi)},
                std::max(a.limit, b.limit),
                std::min(a.spare, b.spare),
                a.signed_errors};
  for (std::size_t i = 0; i < a.x.size(); ++i) result.x.push_back(imp::select(c, a.x[i], b.x[i]));
  return result;
}

}  // namespace imp::affine
