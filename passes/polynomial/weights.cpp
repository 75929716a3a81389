#include "passes/polynomial/weights.h"

#include <cmath>
#include <limits>
#include <optional>

#include "ir/assert.h"

namespace imp {
namespace {

double nearest(mpfr_srcptr value, Type type) {
  return type == f32 ? static_cast<double>(mpfr_get_flt(value, MPFR_RNDN)) : mpfr_get_d(value, MPFR_RNDN);
}

double above(mpfr_srcptr value, Type type) {
  return type == f32 ? static_cast<double>(mpfr_get_flt(value, MPFR_RNDU)) : mpfr_get_d(value, MPFR_RNDU);
}

Expr magnitude(const Interval& a) { return a.facts.nonnegative ? a.hi : max(a.nlo, a.hi); }

// The next partial sum.
Expr accumulated(const std::optional<Expr>& sum, Expr factor, double weight) {
  const Expr w = constant_like(factor, weight);
  if (weight == 1) return sum ? add_up(factor, *sum) : factor;
  return sum ? fma_up(factor, w, *sum) : mul_up(factor, w);
}

}  // namespace

Weight weight(const BigInterval& constant, Type type) {
  const double value = nearest(constant.lo(), type);
  IMP_ASSERT(std::isfinite(value), "a constant within the type");
  BigInterval error;
  mpfi_sub_d(error, constant, value);
  mpfi_abs(error, error);
  return {value, above(error.hi(), type)};
}

Interval weighted_sum(std::span<const Weight> weights, std::span<const Interval> terms) {
  IMP_ASSERT(weights.size() == terms.size(), "a weight for every term");
  std::optional<Expr> nlo, hi, error;
  std::optional<Truth> empty, continuous;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const Weight& w = weights[i];
    const Interval& term = terms[i];
    if (w.value == 0 && w.error == 0) continue;
    const bool turned = w.value < 0;
    if (w.value != 0) nlo = accumulated(nlo, turned ? term.hi : term.nlo, std::abs(w.value));
    if (w.value != 0) hi = accumulated(hi, turned ? term.nlo : term.hi, std::abs(w.value));
    if (w.error > 0) error = accumulated(error, magnitude(term), w.error);
    empty = empty ? *empty || term.empty : term.empty;
    continuous = continuous ? *continuous && term.continuous : term.continuous;
  }
  IMP_ASSERT(nlo.has_value(), "a weight that is not 0");
  if (error) nlo = add_up(*nlo, *error), hi = add_up(*hi, *error);
  return {*nlo, *hi, *empty, *continuous, {}};
}

}  // namespace imp
