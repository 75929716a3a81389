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

bool is_zero(Expr a) { return a.graph->number(a.id) == 0.0; }

// The part 0 stays out of it: no form drops out by that, as its other parts tell (see `mul`).
Expr product(Expr a, Expr b) { return is_zero(a) ? a : is_zero(b) ? b : a * b; }
Expr sum_of_product(Expr a, Expr b, Expr c) {
  if (is_zero(a) || is_zero(b)) return c;
  return is_zero(c) ? a * b : imp::fma(a, b, c);
}
Expr sum_of_product_up(Expr a, Expr b, Expr c) {
  if (is_zero(a) || is_zero(b)) return c;
  return is_zero(c) ? mul_up(a, b) : fma_up(a, b, c);
}

// What limits grow by in a rule, all roundings included.
double grown(double limit) { return 1.001 * limit + 1e-20; }

Expr deviation(const Affine& a) {  // Σ|xi|
  Expr sum = zero(a.c);
  for (const Expr x : a.x) sum = add_up(sum, abs(x));
  return sum;
}

Expr size(const Affine& a) {  // |c| + Σ|xi|
  Expr sum = abs(a.c);
  for (const Expr x : a.x) sum = add_up(sum, abs(x));
  return sum;
}

std::size_t parts(const Affine& a) { return a.x.size() + 1; }

// Pays for `count` flushed results.
void pay(Affine& a, std::size_t count) {
  a.spare -= static_cast<int>(count);
  if (a.spare >= 0) return;
  a.e = add_up(a.e, constant_like(a.e, reserve(a.e.type())));
  a.spare += flushes;
}

// Charges `roundings` eps of the sum `charged` of computed parts. Rounding upward, what overflows below becomes
// the largest number, not infinity: with e added, which is not 0, the sum makes an infinity of it, and so e.
void charge(Affine& a, double roundings, Expr charged) {
  if (is_zero(charged)) return;
  if (!is_bounded(a)) charged = add_up(charged, a.e);
  a.e = sum_of_product_up(constant_like(a.e, roundings * eps(a.e.type())), charged, a.e);
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
Affine joined(const Affine& a, const Affine& b, Join join) {
  Affine result{join(a.c, b.c),
                {},
                add_up(a.e, b.e),
                grown(a.limit + b.limit),
                std::min(a.spare, flushes) + std::min(b.spare, flushes)};
  Expr charged = is_zero(a.c) || is_zero(b.c) ? zero(a.c) : abs(result.c);
  for (std::size_t i = 0; i < a.x.size(); ++i) {
    result.x.push_back(join(a.x[i], b.x[i]));
    if (!is_zero(a.x[i]) && !is_zero(b.x[i])) charged = add_up(charged, abs(result.x[i]));
  }
  charge(result, 1, charged);
  pay(result, parts(a));
  return result;
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

Affine constant(Expr like, std::size_t symbols, double value, double error) {
  Affine result{constant_like(like, value), std::vector(symbols, zero(like)), zero(like),
                grown(std::abs(value) + error), 0};
  if (error > 0) {
    result.e = rounded_up(*like.graph, like.type(), error + reserve(like.type()));
    result.spare = flushes - 1;
  }
  return result;
}

// With x not below the distance from c to either end, u = (v - c)/x lies in [-1, 1] for every v in it, whatever
// c is.
Affine of_interval(const Interval& a, std::size_t symbols, std::optional<std::size_t> symbol, double limit) {
  const Expr none = zero(a.hi), spare = constant_like(a.hi, reserve(a.hi.type()));
  Affine result{a.hi, std::vector(symbols, none), spare, grown(limit), flushes - 1};
  if ((-a.hi).id == a.nlo.id) return result;  // a point
  result.c = 0.5 * (a.hi - a.nlo);
  const Expr distance = max(add_up(a.hi, -result.c), add_up(a.nlo, result.c));
  if (symbol)
    result.x[*symbol] = distance;
  else
    result.e = add_up(distance, spare);
  return result;
}

Expr radius(const Affine& a) { return add_up(deviation(a), a.e); }
Expr magnitude(const Affine& a) { return add_up(size(a), a.e); }
Truth is_form(const Affine& a) {
  return is_bounded(a) ? truth_of(*a.c.graph, true) : magnitude(a) < infinity;
}

Ends ends(const Affine& a) {
  const Expr r = radius(a);
  return {add_up(r, -a.c), add_up(r, a.c)};
}

Affine neg(const Affine& a) {
  Affine result = a;
  result.c = -a.c;
  for (Expr& x : result.x) x = is_zero(x) ? x : -x;
  return result;
}

Affine add(const Affine& a, const Affine& b) {
  return joined(a, b, [](Expr p, Expr q) { return is_zero(p) ? q : is_zero(q) ? p : p + q; });
}

Affine sub(const Affine& a, const Affine& b) {
  return joined(a, b, [](Expr p, Expr q) { return is_zero(q) ? p : is_zero(p) ? -q : p - q; });
}

// Eq. 15, last line. Where both depend on one and the same symbol only, the product of these parts is p u²,
// which lies within |p|/2 of p/2.
//
// Roundings: a part is a sum of at most two products, each rounded, and the sum: (2 eps + eps²) of the sum of
// their magnitudes. p/2 counts three times: as an addend, for the sum, and because |p|/2 stands for the exact
// one: 3/2 eps |p| in all. The magnitudes |c1 c2|, |c1 x2|, |c2 x1|, |p| are terms of M1 M2, where Mi is
// the magnitude of an operand, so 2.5 eps M1 M2 pays; and where a term overflows, M1 M2 is infinite.
Affine mul(const Affine& a, const Affine& b) {
  const auto diagonal = only_symbol(a, b);
  const Type type = a.c.type();
  const Expr all = fma_up(magnitude(a), magnitude(b), constant_like(a.c, reserve(type) / eps(type)));
  Affine result{product(a.c, b.c),
                {},
                mul_up(all, constant_like(all, 2.5 * eps(type))),
                grown(a.limit * b.limit),
                flushes - 3 * static_cast<int>(parts(a))};
  if (std::isnan(result.limit)) result.limit = infinity;
  for (std::size_t i = 0; i < a.x.size(); ++i)
    result.x.push_back(sum_of_product(a.c, b.x[i], product(b.c, a.x[i])));
  if (diagonal) {
    const Expr p = product(a.x[*diagonal], b.x[*diagonal]), half = constant_like(p, 0.5);
    result.c = sum_of_product(a.c, b.c, half * p);
    result.e = sum_of_product_up(half, abs(p), result.e);
    result.e = sum_of_product_up(magnitude(a), b.e, result.e);
    result.e = sum_of_product_up(size(b), a.e, result.e);
  } else {
    result.e = sum_of_product_up(radius(a), radius(b), result.e);
    result.e = sum_of_product_up(abs(a.c), b.e, result.e);
    result.e = sum_of_product_up(abs(b.c), a.e, result.e);
  }
  return result;
}

// With v = c + r, |r| <= R: v² = c² + 2 c r + r², and r² lies within h of any h >= R²/2.
//
// Roundings: c² + h (2 eps + eps²) c² + eps h; each 2 c x eps; so 2.5 eps M² pays.
Affine square(const Affine& a) {
  const Type type = a.c.type();
  const Expr r = radius(a), m = magnitude(a);
  const Expr h = mul_up(constant_like(r, 0.5), mul_up(r, r)), twice = 2.0 * a.c;
  const Expr all = fma_up(m, m, constant_like(m, reserve(type) / eps(type)));
  Affine result{sum_of_product(a.c, a.c, h),
                {},
                fma_up(all, constant_like(all, 2.5 * eps(type)), h),
                grown(a.limit * a.limit),
                flushes - 3 * static_cast<int>(parts(a))};
  for (const Expr x : a.x) result.x.push_back(product(twice, x));
  result.e = sum_of_product_up(abs(twice), a.e, result.e);
  return result;
}

// v³ = c³ + 3 c² r + 3 c r² + r³, where 3 c r² lies within 3/2 |c| R² of 3/2 c R², and |r³| <= R³.
//
// Roundings: c (c² + 3/2 R²) four at most, 3 c² x three, 3 c² e one for c²; so 4 eps M³ pays. A flushed c² or
// R² counts |c|, 3 |x| or 3 e times: hence the reserve inside the product too.
Affine cube(const Affine& a) {
  const Type type = a.c.type();
  const Expr r = radius(a), m = magnitude(a), spare = constant_like(m, reserve(type) / eps(type));
  const Expr all = fma_up(m, fma_up(m, m, spare), spare);
  const Expr cc = a.c * a.c, rr = mul_up(r, r), slope = 3.0 * cc;
  Affine result{product(a.c, imp::fma(rr, constant_like(rr, 1.5), cc)),
                {},
                mul_up(all, constant_like(all, 4 * eps(type))),
                grown(a.limit * a.limit * a.limit),
                flushes - 8 * static_cast<int>(parts(a))};
  for (const Expr x : a.x) result.x.push_back(product(slope, x));
  result.e = sum_of_product_up(slope, a.e, result.e);
  result.e = fma_up(rr, mul_up(constant_like(r, 1.5), abs(a.c)), result.e);
  result.e = fma_up(rr, r, result.e);
  return result;
}

// A power of two scales exactly. Else a part is off by eps of itself for the product, and by 2 eps of the exact
// one for a factor that is not exact: 3 eps and some eps² of itself; the factor of e is raised by more than that.
Affine scale(const Affine& a, double value, bool exact) {
  const bool power_of_two = exact && is_power_of_two(value);
  const Type type = a.c.type();
  const Expr factor = constant_like(a.c, value);
  const double grow = std::abs(value) * (exact ? 1 : 1 + 3 * eps(type));
  Affine result{product(a.c, factor), {}, zero(a.e), grown(grow * a.limit), a.spare};
  if (std::isnan(result.limit)) result.limit = infinity;
  for (const Expr x : a.x) result.x.push_back(product(x, factor));
  const bool shrinks = !power_of_two || std::abs(value) < 1;
  result.e = sum_of_product_up(rounded_up(*a.c.graph, type, grow), a.e,
                               shrinks ? constant_like(a.e, reserve(type)) : zero(a.e));
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
  const Expr around = max(add_up(rest.nlo, m), add_up(rest.hi, -m));
  const Expr steeper = add_up(steep, constant_like(steep, smallest_normal(type) / eps(type)));
  const Expr all = fma_up(steeper, size(a), add_up(abs(m), constant_like(m, reserve(type) / eps(type))));
  Affine result{sum_of_product(factor, a.c, m),
                {},
                fma_up(all, constant_like(all, 2.5 * eps(type)), sum_of_product_up(steep, a.e, around)),
                limit,
                flushes - 3 * static_cast<int>(parts(a))};
  for (const Expr x : a.x) result.x.push_back(product(factor, x));
  return result;
}

Affine select(Truth c, const Affine& a, const Affine& b) {
  Affine result{imp::select(c, a.c, b.c),
                {},
                imp::select(c, a.e, b.e),
                std::max(a.limit, b.limit),
                std::min(a.spare, b.spare)};
  for (std::size_t i = 0; i < a.x.size(); ++i) result.x.push_back(imp::select(c, a.x[i], b.x[i]));
  return result;
}

}  // namespace imp::affine
