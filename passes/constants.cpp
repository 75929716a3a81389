// Constant sub-expressions in 160 bits: the ops over intervals, and over what is known of a constant.
#include "passes/constants.h"

#include <cmath>
#include <limits>

#include "ir/chebyshev.h"
#include "ir/infinity.h"
#include "ir/regions.h"
#include "ir/replay.h"
#include "passes/multiprecision.h"

namespace imp {
namespace {

// What is known of a constant: that it lies in `x`. Truths are 0 and 1, and [0, 1] if undecided.
struct Known {
  BigInterval x;
  bool empty = false;      // it has no value
  bool continuous = true;  // it has a value, and no jump lies in the way
};

Known nothing() { return {{}, true, false}; }
Known truth_in(bool must, bool may) { return {{must ? 1.0 : 0.0, may ? 1.0 : 0.0}}; }
bool must(const Known& c) { return mpfr_sgn(c.x.lo()) > 0; }
bool may(const Known& c) { return mpfr_sgn(c.x.hi()) > 0; }

// A result with a NaN for an end is anything; one without bounds is near a pole, or beyond MPFR.
Known checked(Known a) {
  if (a.x.is_nan()) a.x = {-infinity, infinity};
  a.continuous = a.continuous && !a.empty && a.x.is_bounded();
  return a;
}

// `a` where it lies in [lo, hi], the domain of the function that is to come.
Known within(Known a, double lo, double hi) {
  if (a.empty || mpfr_cmp_d(a.x.hi(), lo) < 0 || mpfr_cmp_d(a.x.lo(), hi) > 0) return nothing();
  const BigInterval domain(lo, hi);
  const BigInterval inside = max(min(a.x, BigInterval(hi)), BigInterval(lo));
  if (mpfi_is_inside(a.x, domain) <= 0) a.continuous = false;
  a.x = inside;
  return a;
}

using Unary = int (*)(mpfi_ptr, mpfi_srcptr);
using Binary = int (*)(mpfi_ptr, mpfi_srcptr, mpfi_srcptr);

Known lift(Unary f, const Known& a) {
  if (a.empty) return nothing();
  Known result{{}, false, a.continuous};
  f(result.x, a.x);
  return checked(result);
}

Known lift(Binary f, const Known& a, const Known& b) {
  if (a.empty || b.empty) return nothing();
  Known result{{}, false, a.continuous && b.continuous};
  f(result.x, a.x, b.x);
  return checked(result);
}

// The ops. Where a jump cannot be decided (is sqrt(2)*sqrt(2) below 2?), the result holds both sides;
// or, if `likely`, the one side that is meant: equality, or the integer.
struct Rules {
  using Value = Known;
  bool likely = false;
  bool undecided = false;  // that happened

  Known add(const Known& a, const Known& b) { return lift(mpfi_add, a, b); }
  Known sub(const Known& a, const Known& b) { return lift(mpfi_sub, a, b); }
  Known mul(const Known& a, const Known& b) { return lift(mpfi_mul, a, b); }
  Known div(const Known& a, const Known& b) {
    return !b.empty && b.x.is(0) ? nothing() : lift(mpfi_div, a, b);
  }
  Known fma(const Known& a, const Known& b, const Known& c) { return add(mul(a, b), c); }
  Known neg(const Known& a) { return lift(mpfi_neg, a); }
  Known abs(const Known& a) { return lift(mpfi_abs, a); }
  Known min(const Known& a, const Known& b) {
    return or_second(a, b, [](auto& x, auto& y) { return imp::min(x, y); });
  }
  Known max(const Known& a, const Known& b) {
    return or_second(a, b, [](auto& x, auto& y) { return imp::max(x, y); });
  }
  Known sqrt(const Known& a) { return lift(mpfi_sqrt, within(a, 0, infinity)); }
  Known cbrt(const Known& a) { return lift(mpfi_cbrt, a); }

  Known floor(Known a) {
    if (a.empty) return nothing();
    const BigInterval before = a.x;
    a.x = imp::floor(a.x);
    const bool jumps = !a.x.is_point();
    a.continuous = a.continuous && !jumps && mpfr_cmp(before.lo(), a.x.lo()) > 0;
    if (jumps && decide()) mpfr_set(a.x.lo(), a.x.hi(), MPFR_RNDD);
    return checked(a);
  }
  Known ceil(const Known& a) { return neg(floor(neg(a))); }
  Known sign(const Known& a) {
    if (a.empty) return nothing();
    const double lo = sign_of(a.x.lo()), hi = sign_of(a.x.hi());
    const bool settled = lo < hi && decide();
    return {settled ? BigInterval(0) : BigInterval(lo, hi), false, a.continuous && !a.x.holds_zero()};
  }
  Known mod(const Known& a, const Known& b) { return sub(a, mul(b, floor(div(a, b)))); }

  Known powi(const Known& a, const Known& b) {
    const long n = mpfr_get_si(b.x.lo(), MPFR_RNDN);
    if (a.empty) return nothing();
    if (n == 0) return {1.0, false, a.continuous};
    const Known product = checked({power(a.x, std::abs(n)), false, a.continuous});
    return n < 0 ? div({1.0}, product) : product;
  }
  Known chebyshev(const Known& a, const Known& degree, const Known& order) {
    if (a.empty) return nothing();
    const auto integer = [](const Known& k) {
      return static_cast<unsigned>(mpfr_get_ui(k.x.lo(), MPFR_RNDN));
    };
    const auto constant = [](double c) { return BigInterval(c); };
    return checked({imp::chebyshev(a.x, integer(degree), integer(order), constant), false, a.continuous});
  }
  Known pow(const Known& a, const Known& b) {
    const Known base = within(a, 0, infinity);
    if (base.empty || b.empty || (base.x.is(0) && mpfr_sgn(b.x.hi()) < 0)) return nothing();
    const bool smooth = mpfr_sgn(base.x.lo()) > 0 || mpfr_sgn(b.x.lo()) > 0;
    return checked({power(base.x, b.x), false, base.continuous && b.continuous && smooth});
  }

  Known exponent(const Known& a) {
    if (a.empty) return nothing();
    BigInterval size, result;
    mpfi_abs(size, a.x);
    mpfr_set_d(result.lo(), exponent_of(size.lo()), MPFR_RNDD);
    mpfr_set_d(result.hi(), exponent_of(size.hi()), MPFR_RNDU);
    return checked({result, false, false});
  }
  Known scale2(const Known& a, const Known& k) {
    const Known limited = max(min(floor(k), {5000.0}), {-5000.0});
    return limited.empty ? limited : mul(a, {power(BigInterval(2), limited.x), false, limited.continuous});
  }

  Known exp(const Known& a) { return lift(mpfi_exp, a); }
  Known log(const Known& a) { return a.x.is(0) ? nothing() : lift(mpfi_log, within(a, 0, infinity)); }
  Known sin(const Known& a) { return too_far(a) ? anything(-1, 1) : lift(mpfi_sin, a); }
  Known cos(const Known& a) { return too_far(a) ? anything(-1, 1) : lift(mpfi_cos, a); }
  Known tan(const Known& a) { return too_far(a) ? anything(-infinity, infinity) : lift(mpfi_tan, a); }
  Known asin(const Known& a) { return lift(mpfi_asin, within(a, -1, 1)); }
  Known acos(const Known& a) { return lift(mpfi_acos, within(a, -1, 1)); }
  Known atan(const Known& a) { return lift(mpfi_atan, a); }
  Known atan2(const Known& y, const Known& x) {
    if (!y.empty && !x.empty && y.x.is(0) && x.x.is(0)) return {0.0, false, false};  // as meaning has it
    Known result = lift(mpfi_atan2, y, x);
    const bool meets_cut = y.x.holds_zero() && mpfr_sgn(x.x.lo()) <= 0;
    result.continuous = result.continuous && !meets_cut;
    return result;
  }
  Known sinh(const Known& a) { return lift(mpfi_sinh, a); }
  Known cosh(const Known& a) { return lift(mpfi_cosh, a); }
  Known tanh(const Known& a) { return lift(mpfi_tanh, a); }
  Known asinh(const Known& a) { return lift(mpfi_asinh, a); }
  Known acosh(const Known& a) { return lift(mpfi_acosh, within(a, 1, infinity)); }
  Known atanh(const Known& a) {
    return a.x.is(1) || a.x.is(-1) ? nothing() : lift(mpfi_atanh, within(a, -1, 1));
  }

  Known add_up(const Known& a, const Known& b) { return add(a, b); }
  Known mul_up(const Known& a, const Known& b) { return mul(a, b); }
  Known div_up(const Known& a, const Known& b) { return div(a, b); }
  Known sqrt_up(const Known& a) { return sqrt(a); }
  Known fma_up(const Known& a, const Known& b, const Known& c) { return fma(a, b, c); }
  Known widen(const Known& a) { return a; }
  Known narrow(const Known& a) { return a.empty ? a : checked({to_float(a.x), false, a.continuous}); }
  Known narrow_up(const Known& a) { return narrow(a); }

  Known lt(const Known& a, const Known& b) {
    return compared(a, b, mpfr_less_p(a.x.hi(), b.x.lo()), mpfr_less_p(a.x.lo(), b.x.hi()), false);
  }
  Known le(const Known& a, const Known& b) {
    return compared(a, b, mpfr_lessequal_p(a.x.hi(), b.x.lo()), mpfr_lessequal_p(a.x.lo(), b.x.hi()), true);
  }
  Known eq(const Known& a, const Known& b) {
    const bool same = a.x.is_point() && b.x.is_point() && mpfr_equal_p(a.x.lo(), b.x.lo());
    const bool meet = mpfr_lessequal_p(a.x.lo(), b.x.hi()) && mpfr_lessequal_p(b.x.lo(), a.x.hi());
    return compared(a, b, same, meet, true);
  }
  Known and_(const Known& a, const Known& b) { return {imp::min(a.x, b.x)}; }
  Known or_(const Known& a, const Known& b) { return {imp::max(a.x, b.x)}; }
  Known not_(const Known& a) { return truth_in(!may(a), !must(a)); }
  Known any(const Known& a) { return a; }
  Known all(const Known& a) { return a; }

  Known select(const Known& c, const Known& a, const Known& b) {
    if (must(c) || !may(c)) return must(c) ? a : b;
    if (a.empty && b.empty) return nothing();
    if (a.empty || b.empty) return {a.empty ? b.x : a.x, false, false};
    return {hull(a.x, b.x), false, false};
  }

 private:
  static double sign_of(mpfr_srcptr end) { return (mpfr_sgn(end) > 0) - (mpfr_sgn(end) < 0); }
  static double exponent_of(mpfr_srcptr end) {
    if (mpfr_zero_p(end)) return -infinity;
    return mpfr_inf_p(end) ? infinity : static_cast<double>(mpfr_get_exp(end) - 1);
  }

  // Beyond the doubles, where a sine needs as many digits of pi as its operand has places.
  static bool too_far(const Known& a) {
    const auto beyond = [](mpfr_srcptr end) {
      return mpfr_number_p(end) && !mpfr_zero_p(end) && mpfr_get_exp(end) > 1024;
    };
    return !a.empty && (beyond(a.x.lo()) || beyond(a.x.hi()));
  }
  Known anything(double lo, double hi) { return decide() ? nothing() : checked({{lo, hi}, false, true}); }

  bool decide() {
    undecided = true;
    return likely;
  }

  // b where a has no value (ir/ops.def), and so perhaps b where a may have none.
  template <class F>
  Known or_second(const Known& a, const Known& b, F f) const {
    if (b.empty) return nothing();
    if (a.empty) return b;
    const BigInterval both = f(a.x, b.x);
    return checked({a.continuous || likely ? both : hull(both, b.x), false, a.continuous && b.continuous});
  }

  // A comparison that holds for all values, or for some. One without a value is false.
  Known compared(const Known& a, const Known& b, int always, int sometimes, bool if_equal) {
    if (a.empty || b.empty) return truth_in(false, false);
    bool certain = always != 0;
    const bool possible = sometimes != 0;
    if (certain != possible && decide()) return truth_in(if_equal, if_equal);
    if (!likely && !(a.continuous && b.continuous)) certain = false;  // it may be that one has none
    return truth_in(certain, possible);
  }
};

// Whether a jump could not be decided.
bool evaluate(const Program& program, bool likely, std::vector<std::optional<Known>>& values) {
  const Graph& graph = program.graph;
  const auto region = regions(program);
  Rules rules{likely};
  values.assign(graph.size(), std::nullopt);
  std::vector<Known> args;
  for (std::uint32_t i = 0; i < graph.size(); ++i) {
    const Node node = graph[Id{i}];
    if (region[i] != Region::constant() || node.type.is_table()) continue;
    if (node.op == Op::constant) {
      const double value = graph.number(Id{i}).value_or(static_cast<double>(node.payload));
      values[i] = std::isnan(value) ? nothing() : checked({value});
      continue;
    }
    args.clear();
    for (Id arg : node.args)
      if (values[arg.index]) args.push_back(*values[arg.index]);
    if (args.size() == node.args.size()) values[i] = apply(rules, node.op, args);
  }
  return rules.undecided;
}

double without_sign_of_zero(double a) { return a == 0 ? 0.0 : a; }

// Its middle, which an infinite end draws to itself; NaN between two of them.
void middle(mpfr_ptr mid, const BigInterval& x) {
  if (x.is_bounded())
    mpfi_mid(mid, x);
  else
    mpfr_add(mid, x.lo(), x.hi(), MPFR_RNDN);
}

Enclosure enclosure(const Known& sure, const Known& likely) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (sure.empty) return {infinity, -infinity, nan, std::numeric_limits<float>::quiet_NaN(), false};
  Enclosure result;
  result.lo = without_sign_of_zero(mpfr_get_d(sure.x.lo(), MPFR_RNDD));
  result.hi = without_sign_of_zero(mpfr_get_d(sure.x.hi(), MPFR_RNDU));
  result.continuous = sure.continuous;

  mpfr_t mid;
  mpfr_init2(mid, BigInterval::precision + 10);
  middle(mid, likely.x);
  if (likely.empty) mpfr_set_nan(mid);
  result.nearest = without_sign_of_zero(mpfr_get_d(mid, MPFR_RNDN));
  result.nearest_float = static_cast<float>(without_sign_of_zero(mpfr_get_flt(mid, MPFR_RNDN)));
  mpfr_clear(mid);
  return result;
}

}  // namespace

std::vector<std::optional<Enclosure>> constant_values(const Program& program) {
  std::vector<std::optional<Known>> sure, likely;
  const bool undecided = evaluate(program, false, sure);
  if (undecided) evaluate(program, true, likely);

  std::vector<std::optional<Enclosure>> result(sure.size());
  for (std::size_t i = 0; i < sure.size(); ++i) {
    if (!sure[i]) continue;
    result[i] = enclosure(*sure[i], undecided ? *likely[i] : *sure[i]);
    if (program.graph.is_number(Id{static_cast<std::uint32_t>(i)}, -0.0))  // MPFI has one zero
      result[i]->nearest = -0.0, result[i]->nearest_float = -0.0f;
  }
  mpfr_free_cache();
  return result;
}

Enclosure constant_value(Op op, std::span<const double> args) {
  Program program;
  std::vector<Id> ids;
  for (const double arg : args) ids.push_back(program.graph.constant(f64, arg));
  const Id id = program.graph.add(op, ids);
  return *constant_values(program)[id.index];
}

}  // namespace imp
