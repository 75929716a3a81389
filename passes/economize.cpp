#include "passes/economize.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "ir/assert.h"
#include "ir/expr.h"
#include "passes/sum_of_polynomials.h"

namespace imp {
namespace {

constexpr std::size_t most_atoms_of_a_term = 32;  // beyond, a term is looked at for each of them in vain

using Polynomial = std::vector<BigInterval>;  // from the power 0, or T_0, on

BigInterval scaled(const BigInterval& a, double power_of_2) { return a * BigInterval(power_of_2); }

void add_to(Polynomial& sum, const Polynomial& a) {
  if (sum.size() < a.size()) sum.resize(a.size(), BigInterval(0));
  for (std::size_t i = 0; i < a.size(); ++i) sum[i] = sum[i] + a[i];
}

// [lo, hi] as middle + radius t with t in [-1, 1].
struct Scale {
  BigInterval middle, radius;
  explicit Scale(const Range& r)
      : middle(scaled(BigInterval(r.lo) + BigInterval(r.hi), 0.5)),
        radius(scaled(BigInterval(r.hi) - BigInterval(r.lo), 0.5)) {}
};

// The coefficients of `p` in T_k(t), by Horner's rule with t T_k = (T_k+1 + T_k-1)/2.
Polynomial in_chebyshev_basis(const Polynomial& p, const Scale& scale) {
  Polynomial series;
  for (std::size_t i = p.size(); i-- > 0;) {
    Polynomial next(series.size() + 1, BigInterval(0));
    for (std::size_t k = 0; k < series.size(); ++k) {
      const BigInterval moved = scaled(scale.radius * series[k], k == 0 ? 1 : 0.5);
      next[k] = next[k] + scale.middle * series[k];
      next[k + 1] = next[k + 1] + moved;
      if (k > 0) next[k - 1] = next[k - 1] + moved;
    }
    next[0] = next[0] + p[i];
    series = std::move(next);
  }
  return series;
}

// At least |p| over the interval, as no |T_k| passes 1.
double bound(const Polynomial& p, const Scale& scale) {
  BigInterval sum;
  for (const BigInterval& c : in_chebyshev_basis(p, scale)) {
    BigInterval size;
    mpfi_abs(size, c);
    sum = sum + size;
  }
  return mpfr_get_d(sum.hi(), MPFR_RNDU);
}

// The first terms of a series as doubles: about the coefficients of the powers.
Polynomial in_powers(const Polynomial& series, std::size_t terms, const Scale& scale) {
  const auto times_t = [&](const Polynomial& p) {
    Polynomial result(p.size() + 1, BigInterval(0));
    for (std::size_t i = 0; i < p.size(); ++i) {
      result[i + 1] = result[i + 1] + p[i];
      result[i] = result[i] - scale.middle * p[i];
    }
    for (BigInterval& c : result) mpfi_div(c, c, scale.radius);
    return result;
  };
  Polynomial sum, before, current{BigInterval(1)};
  for (std::size_t k = 0; k < terms; ++k) {
    Polynomial term = current;
    for (BigInterval& c : term) c = c * series[k];
    add_to(sum, term);
    Polynomial next = times_t(current);
    if (k > 0) {
      for (BigInterval& c : next) c = scaled(c, 2);
      for (BigInterval& c : before) c = BigInterval(0) - c;
      add_to(next, before);
    }
    before = std::move(current);
    current = std::move(next);
  }
  for (BigInterval& c : sum) c = BigInterval(mpfi_get_d(c));
  return sum;
}

struct Approximation {
  Polynomial powers;  // doubles
  double error;
};

// With as few terms as keep within `tolerance`; nothing if that is all of them.
std::optional<Approximation> cut(const Polynomial& p, const Range& range, double tolerance) {
  if (!(std::isfinite(range.lo) && std::isfinite(range.hi) && range.lo < range.hi)) return std::nullopt;
  const Scale scale(range);
  const Polynomial series = in_chebyshev_basis(p, scale);
  double tail = 0;
  std::size_t terms = series.size();
  while (terms > 1) {
    tail += std::abs(mpfi_get_d(series[terms - 1]));
    if (!(tail < tolerance)) break;
    --terms;
  }
  for (; terms < series.size(); ++terms) {
    Polynomial powers = in_powers(series, terms, scale), difference = p;
    for (std::size_t i = 0; i < powers.size(); ++i) difference[i] = difference[i] - powers[i];
    if (const double error = bound(difference, scale); error <= tolerance)
      return Approximation{std::move(powers), error};
  }
  return std::nullopt;
}

// A node that is added to f, or subtracted; and its polynomials, where all its atoms are inputs.
struct Summand {
  Id id;
  bool negated;
  std::optional<SumOfPolynomials> view;
};

class Economizer {
 public:
  Economizer(const Program& f, std::span<const Range> domain) : f_(f), domain_(domain) {
    const auto views = sums_of_polynomials(f, most_atoms_of_a_term);
    std::vector<std::pair<Id, bool>> open{{f.outputs[0].id, false}};
    while (!open.empty()) {
      const auto [id, negated] = open.back();
      open.pop_back();
      const Node node = f.graph[id];
      if (node.op == Op::add || node.op == Op::sub) {
        open.emplace_back(node.args[1], negated != (node.op == Op::sub));
        open.emplace_back(node.args[0], negated);
      } else if (node.op == Op::neg) {
        open.emplace_back(node.args[0], !negated);
      } else {
        summands_.push_back({id, negated, of_inputs(views[id.index])});
      }
    }
  }

  Economized run(double tolerance) {
    std::map<Id, Polynomial> polynomials = sums([](const Summand&) { return true; });
    std::map<Id, Approximation> cuts;
    double left = tolerance;
    for (const bool shared : {true, false}) {  // then what is left for the first that can use it
      auto waiting = static_cast<double>(polynomials.size());
      for (const auto& [input, p] : polynomials) {
        const auto known = cuts.find(input);
        const double own = known == cuts.end() ? 0 : known->second.error;
        const double share = own + (shared ? left / waiting-- : left);
        const auto approximation = cut(p, range_of(input), share);
        if (!approximation) continue;
        left += own - approximation->error;
        cuts.insert_or_assign(input, *approximation);
      }
    }
    if (cuts.empty()) return {f_, 0};
    return rebuilt(cuts);
  }

 private:
  std::optional<SumOfPolynomials> of_inputs(const std::optional<SumOfPolynomials>& view) const {
    if (!view || view->parts.empty()) return std::nullopt;
    for (const auto& [atom, coefficients] : view->parts)
      if (f_.graph[atom].op != Op::input) return std::nullopt;
    return view;
  }

  // By input, of the summands chosen; constants are left out.
  template <class Choose>
  std::map<Id, Polynomial> sums(Choose chosen) const {
    std::map<Id, Polynomial> result;
    for (const Summand& s : summands_) {
      if (!s.view || !chosen(s)) continue;
      for (const auto& [atom, coefficients] : s.view->parts) {
        Polynomial p{BigInterval(0)};
        for (const BigInterval& c : coefficients) p.push_back(s.negated ? BigInterval(0) - c : c);
        add_to(result[atom], p);
      }
    }
    return result;
  }

  // Summands without an input that was cut stay as they are.
  Economized rebuilt(const std::map<Id, Approximation>& cuts) const {
    const auto changes = [&](const Summand& s) {
      return s.view &&
             std::ranges::any_of(s.view->parts, [&](const auto& part) { return cuts.contains(part.first); });
    };
    Program result = f_;
    Graph& graph = result.graph;
    std::optional<Expr> sum;
    const auto append = [&](Expr e, bool negated) {
      sum = sum ? (negated ? *sum - e : *sum + e) : negated ? -e : e;
    };
    Polynomial constant{BigInterval(0)};
    for (const Summand& s : summands_)
      if (!changes(s))
        append({&graph, s.id}, s.negated);
      else
        constant[0] = s.negated ? constant[0] - s.view->constant : constant[0] + s.view->constant;

    BigInterval error(rounded(constant, {-1, 1}));
    for (auto& [input, p] : sums(changes)) {
      const auto known = cuts.find(input);
      error = error + BigInterval(known == cuts.end() ? rounded(p, range_of(input)) : known->second.error);
      const Polynomial& powers = known == cuts.end() ? p : known->second.powers;
      for (std::size_t i = powers.size(); i-- > 0;) append_power({&graph, input}, i, powers[i], append);
    }
    append_power({&graph, f_.inputs[0].id}, 0, constant[0], append);
    if (!error.is_bounded()) return {f_, 0};
    result.outputs[0].id = sum ? sum->id : graph.constant(f64, 0);
    return {compact(result), mpfr_get_d(error.hi(), MPFR_RNDU)};
  }

  // Appends c x^i.
  template <class Append>
  static void append_power(Expr x, std::size_t i, const BigInterval& c, Append append) {
    const double factor = mpfi_get_d(c);
    if (factor == 0) return;
    if (i == 0) return append(constant_like(x, std::abs(factor)), factor < 0);
    const Expr power = i == 1 ? x : make(Op::powi, x, constant_like(x, static_cast<double>(i)));
    append(std::abs(factor) == 1 ? power : std::abs(factor) * power, factor < 0);
  }

  Range range_of(Id input) const { return domain_[f_.graph[input].payload]; }

  // Its coefficients become doubles: how far that moves its values.
  static double rounded(Polynomial& p, const Range& range) {
    Polynomial difference = p;
    bool exact = true;
    for (std::size_t i = 0; i < p.size(); ++i) {
      p[i] = BigInterval(mpfi_get_d(p[i]));
      difference[i] = difference[i] - p[i];
      exact = exact && difference[i].is(0);
    }
    return exact ? 0 : bound(difference, Scale(range));
  }

  const Program& f_;
  std::span<const Range> domain_;
  std::vector<Summand> summands_;
};

}  // namespace

Economized economize(const Program& f, std::span<const Range> domain, double tolerance) {
  IMP_ASSERT(f.outputs.size() == 1 && domain.size() == f.inputs.size(), "one output, and a range an input");
  return Economizer(f, domain).run(tolerance);
}

}  // namespace imp
