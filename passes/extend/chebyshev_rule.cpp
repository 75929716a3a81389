// The interval rule of Chebyshev polynomials and their derivatives: values at the ends, by the doublings of
// ir/chebyshev.h and with a bound of their rounding; and the extremes between them. For low degrees these
// are a list. For high ones, where x = cos t, T_n(x) = cos(n t) and T_n'(x) = n sin(n t)/sin t: there the
// rules of acos, cos and sin know the extremes, and lose less than the doublings (Singh 2008, appendix A).
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "ir/assert.h"
#include "ir/chebyshev.h"
#include "ir/infinity.h"
#include "passes/constants.h"
#include "passes/extend/chebyshev_extremes.h"
#include "passes/extend/interval_rules.h"

namespace imp {
namespace {

constexpr unsigned largest_listed_degree = 24;  // docs/decisions/chebyshev.md

unsigned integer(const Interval& constant) {
  const auto value = constant.hi.graph->number(constant.hi.id);
  IMP_ASSERT(value, "a constant integer");
  return static_cast<unsigned>(*value);
}

Interval constant(Expr like, double c) {
  Graph& graph = *like.graph;
  return interval(rounded_up(graph, like.type(), -c), rounded_up(graph, like.type(), c), {c >= 0, true});
}

// A number of the doublings at x = 1, and how far it may be off there and elsewhere, where every op is
// off by `epsilon` at most: by `error` times itself for |x| >= 1, and times its value at 1 for |x| <= 1, which
// none passes there. All that is added is of one sign where |x| >= 1, and what is subtracted is exact, and
// weighs most at 1.
struct Rounded {
  double value, error, epsilon;
};

Rounded operator+(const Rounded& a, const Rounded& b) {
  const double rounding = &a == &b ? 0 : a.epsilon;  // a + a is exact
  return {a.value + b.value, (1 + std::fmax(a.error, b.error)) * (1 + rounding) - 1, a.epsilon};
}
Rounded operator*(const Rounded& a, const Rounded& b) {
  return {a.value * b.value, (1 + a.error) * (1 + b.error) * (1 + a.epsilon) - 1, a.epsilon};
}
Rounded operator-(const Rounded& a, const Rounded& exact) {
  const double value = a.value - exact.value;
  return {value, (1 + a.error * a.value / value) * (1 + a.epsilon) - 1, a.epsilon};
}

// The derivative of order k of T_n.
class ChebyshevRule {
 public:
  ChebyshevRule(const IntervalRules& rules, const Interval& a, unsigned n, unsigned k)
      : rules_(rules), a_(a), n_(n), k_(k), even_((n - k) % 2 == 0), lo_(at(a.lo())), hi_(at(a.hi)) {}

  Interval bounds() const {
    Interval result = n_ <= largest_listed_degree ? of_ends_and_extremes() : of_pieces();
    if (k_ > 0) return result;
    const Expr reach = imp::max(a_.nlo, a_.hi);
    const Expr most = imp::select(reach <= 1, one(reach), constant_like(reach, infinity));
    result.nlo = imp::min(even_ ? one(reach) : most, result.nlo);
    result.hi = imp::min(most, result.hi);
    return result;
  }

 private:
  // The exact value at an end.
  struct Bounds {
    Expr above, minus_below;
  };

  double most() const {
    return a_.hi.type() == f32 ? std::numeric_limits<float>::max() : 0x1.fffffffffffffp1023;
  }

  // Finite: what is larger overflows, and does not become NaN.
  Expr finite(Expr e) const {
    return imp::min(constant_like(e, most()), imp::max(constant_like(e, -most()), e));
  }

  Bounds at(Expr end) const {
    const Expr x = finite(end);
    Graph& graph = *x.graph;
    const double n = n_, k = k_;
    if (const auto number = graph.number(x.id)) {
      const Enclosure value = constant_value(Op::chebyshev, std::array{*number, n, k});
      return {rounded_up(graph, x.type(), value.hi), rounded_up(graph, x.type(), -value.lo)};
    }
    const double epsilon = x.type() == f32 ? 0x1.01p-23 : 0x1.01p-52;  // what is flushed to zero included
    const auto exact = [&](double c) { return Rounded{c, 0, epsilon}; };
    const Rounded at_1 = imp::chebyshev(exact(1), n_, k_, exact);
    if (!(at_1.error < 0.5)) return {constant_like(x, infinity), constant_like(x, infinity)};

    const Expr value = finite(make(Op::chebyshev, x, constant_like(x, n), constant_like(x, k)));
    const Expr scale = imp::max(rounded_up(graph, x.type(), at_1.value), imp::abs(value));
    const Expr error = mul_up(scale, rounded_up(graph, x.type(), at_1.error / (1 - at_1.error)));
    return {add_up(value, error), add_up(-value, error)};
  }

  Interval result(Expr nlo, Expr hi) const { return {nlo, hi, a_.empty, a_.continuous, {}}; }

  static Expr if_there(Truth absent, Expr end) {
    return imp::select(absent, constant_like(end, -infinity), end);
  }

  Interval of_ends_and_extremes() const {
    Expr nlo = imp::max(lo_.minus_below, hi_.minus_below), hi = imp::max(lo_.above, hi_.above);
    const Interval size = rules_.abs(a_);
    const auto number = [&](double c) { return rounded_up(*hi.graph, hi.type(), c); };
    // Those above 0 are maxima, those below it minima.
    const auto include = [&](const Interval& x, double left, double right, double least, double greatest) {
      const Truth absent = x.hi < -number(-left) || x.nlo < -number(right);
      if (greatest > 0) hi = imp::max(if_there(absent, number(greatest)), hi);
      if (least < 0) nlo = imp::max(if_there(absent, number(-least)), nlo);
    };
    for (const ChebyshevExtreme& e : chebyshev_extremes(n_, k_)) {
      include(even_ ? size : a_, e.left, e.right, e.lo, e.hi);
      if (!even_) include(a_, -e.right, -e.left, -e.hi, -e.lo);
    }
    return result(nlo, hi);
  }

  // From `edge` on it rises and is at least `floor`; on the left it is the same, or that negated.
  Interval of_pieces() const {
    const Expr edge = this->edge();
    const Expr minus_floor = constant_like(edge, k_ == 0 ? -1 : 0);
    const Interval inner = middle(edge);
    const Truth no_left = a_.nlo < edge, no_right = a_.hi < edge;  // NaN may be
    const Truth outside = a_.hi < -edge || a_.nlo < -edge;
    const Truth all_left = a_.hi <= -edge, all_right = a_.nlo <= -edge;

    Expr nlo = if_there(outside, inner.nlo), hi = if_there(outside, inner.hi);
    nlo = imp::max(nlo, if_there(no_right, imp::select(all_right, lo_.minus_below, minus_floor)));
    if (even_) {
      nlo = imp::max(nlo, if_there(no_left, imp::select(all_left, hi_.minus_below, minus_floor)));
      hi = imp::max(hi, if_there(no_left, lo_.above));
    } else {
      nlo = imp::max(nlo, if_there(no_left, lo_.minus_below));
      hi = imp::max(hi, if_there(no_left, imp::select(all_left, hi_.above, minus_floor)));
    }
    hi = imp::max(hi, if_there(no_right, hi_.above));
    return result(nlo, hi);
  }

  // T_n is bounded by cosines up to 1; its derivatives rise from its largest critical point, cos(pi/n).
  Expr edge() const {
    const double critical = k_ == 0 ? 1 : std::cos(std::numbers::pi / n_) + 0x1p-50;
    return rounded_up(*a_.hi.graph, a_.hi.type(), std::fmin(critical, 1));
  }

  // Over the part of the interval within [-edge, edge]. Orders from the second on by the differential
  // equation: (1 - x^2) y_k = (2 k - 3) x y_k-1 - (n^2 - (k - 2)^2) y_k-2.
  Interval middle(Expr edge) const {
    const auto inside = [&](Expr end) { return imp::max(-edge, imp::min(edge, end)); };
    const Interval x = interval(inside(a_.nlo), inside(a_.hi), {a_.facts.nonnegative, true});
    const Interval angle = times(n_, rules_.acos(x));
    Interval before = rules_.cos(angle);
    if (k_ == 0) return before;
    Interval rest = rules_.sub(constant(x.hi, 1), rules_.square(x));
    rest.facts = {true, true};
    Interval y = rules_.div(times(n_, rules_.sin(angle)), rules_.sqrt(rest));
    for (unsigned k = 2; k <= k_; ++k) {
      const double square = double(n_) * n_ - double(k - 2) * (k - 2);
      const Interval next =
          rules_.div(rules_.sub(times(2.0 * k - 3, rules_.mul(x, y)), times(square, before)), rest);
      before = y;
      y = next;
    }
    return y;
  }

  Interval times(double c, const Interval& b) const { return rules_.mul(constant(b.hi, c), b); }

  const IntervalRules& rules_;
  const Interval& a_;
  unsigned n_, k_;
  bool even_;
  Bounds lo_, hi_;
};

}  // namespace

Interval IntervalRules::chebyshev(const Interval& a, const Interval& degree, const Interval& order) const {
  const unsigned n = integer(degree), k = integer(order);
  if (n <= k + 1) {  // a constant, or one times x
    double c = 1;
    for (unsigned i = 2; i <= n; ++i) c *= 2.0 * i;
    const Interval factor = constant(a.hi, c);
    if (n == k + 1) return mul(a, factor);
    return {factor.nlo, factor.hi, a.empty, a.continuous, factor.facts};
  }
  if (n == 2) return sub(mul(square(a), constant(a.hi, 2)), constant(a.hi, 1));
  return ChebyshevRule(*this, a, n, k).bounds();
}

}  // namespace imp
