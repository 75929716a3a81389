#include "passes/sum_of_polynomials.h"

#include <algorithm>
#include <cmath>

#include "ir/chebyshev.h"
#include "ir/replay.h"

namespace imp {
namespace {

// Nothing where the view does not hold: the node is then an atom.
struct View : std::optional<SumOfPolynomials> {
  using optional::optional;
};

// Bounded, and without leading zeros. An atom that cancels has a domain that must not be lost.
View checked(SumOfPolynomials sum) {
  if (!sum.constant.is_bounded()) return std::nullopt;
  for (auto& [atom, c] : sum.parts) {
    for (const BigInterval& a : c)
      if (!a.is_bounded()) return std::nullopt;
    while (!c.empty() && c.back().is(0)) c.pop_back();
    if (c.empty() || c.size() > largest_polynomial_degree) return std::nullopt;
  }
  return sum;
}

SumOfPolynomials constant(double c) { return {BigInterval(c), {}}; }

View scaled(const SumOfPolynomials& a, const BigInterval& factor) {
  SumOfPolynomials result{a.constant * factor, a.parts};
  for (auto& [atom, coefficients] : result.parts)
    for (BigInterval& c : coefficients) c = c * factor;
  return checked(std::move(result));
}

View divided(const SumOfPolynomials& a, const BigInterval& divisor) {
  SumOfPolynomials result = a;
  mpfi_div(result.constant, a.constant, divisor);
  for (auto& [atom, coefficients] : result.parts)
    for (BigInterval& c : coefficients) mpfi_div(c, c, divisor);
  return checked(std::move(result));
}

View operator+(const View& a, const View& b) {
  if (!a || !b) return std::nullopt;
  SumOfPolynomials result = *a;
  result.constant = result.constant + b->constant;
  for (const auto& [atom, coefficients] : b->parts) {
    Coefficients& sum = result.parts[atom];
    if (sum.size() < coefficients.size()) sum.resize(coefficients.size(), BigInterval(0));
    for (std::size_t i = 0; i < coefficients.size(); ++i) sum[i] = sum[i] + coefficients[i];
  }
  return checked(std::move(result));
}

View operator-(const View& a) { return a ? scaled(*a, BigInterval(-1)) : std::nullopt; }
View operator-(const View& a, const View& b) { return a + -b; }

View operator*(const View& a, const View& b) {
  if (!a || !b) return std::nullopt;
  if (b->parts.empty()) return scaled(*a, b->constant);
  if (a->parts.empty()) return scaled(*b, a->constant);
  const auto atom = a->only_atom();
  if (!atom || atom != b->only_atom()) return std::nullopt;
  const Coefficients &p = a->parts.begin()->second, &q = b->parts.begin()->second;
  if (p.size() + q.size() > largest_polynomial_degree) return std::nullopt;
  SumOfPolynomials result{a->constant * b->constant, {}};
  Coefficients& product = result.parts[*atom];
  product.assign(p.size() + q.size(), BigInterval(0));
  for (std::size_t i = 0; i < p.size(); ++i) product[i] = product[i] + p[i] * b->constant;
  for (std::size_t k = 0; k < q.size(); ++k) product[k] = product[k] + q[k] * a->constant;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t k = 0; k < q.size(); ++k) product[i + k + 1] = product[i + k + 1] + p[i] * q[k];
  return checked(std::move(result));
}

// How many powers of one atom a view has.
std::size_t degree(const View& a) {
  std::size_t most = 0;
  if (a)
    for (const auto& [atom, coefficients] : a->parts) most = std::max(most, coefficients.size());
  return most;
}

struct ViewRules {
  using Value = View;
  const Graph& graph;

  View add(const View& a, const View& b) { return a + b; }
  View sub(const View& a, const View& b) { return a - b; }
  View neg(const View& a) { return -a; }
  View mul(const View& a, const View& b) { return a * b; }
  View fma(const View& a, const View& b, const View& c) { return a * b + c; }
  View div(const View& a, const View& b) {
    if (!a || !b || !b->parts.empty() || b->constant.holds_zero()) return std::nullopt;
    return divided(*a, b->constant);
  }
  View powi(const View& a, const View& exponent) {
    const auto n = integer(exponent);
    if (!a || !n || *n < 0 || static_cast<double>(degree(a)) * *n > largest_polynomial_degree)
      return std::nullopt;
    if (*n == 0) return unit(*a);
    View power = a;
    for (int i = 1; i < *n && power; ++i) power = power * a;
    return power;
  }
  View chebyshev(const View& a, const View& n, const View& order) {
    const auto d = integer(n);
    if (!a || !d || integer(order) != 0.0) return std::nullopt;
    if (static_cast<double>(degree(a)) * *d > largest_polynomial_degree) return std::nullopt;
    if (*d == 0) return unit(*a);
    return imp::chebyshev(a, static_cast<unsigned>(*d), 0, [](double c) { return View(constant(c)); });
  }

 private:
  // a^0: 1 where a has a value, which only inputs have everywhere.
  View unit(const SumOfPolynomials& a) const {
    const auto is_input = [&](const auto& part) { return graph[part.first].op == Op::input; };
    return std::ranges::all_of(a.parts, is_input) ? View(constant(1)) : std::nullopt;
  }
  static std::optional<double> integer(const View& a) {
    if (!a || !a->parts.empty() || !a->constant.is_point()) return std::nullopt;
    return mpfr_get_d(a->constant.lo(), MPFR_RNDN);
  }
};

}  // namespace

std::vector<std::optional<SumOfPolynomials>> sums_of_polynomials(const Program& f, std::size_t most_atoms) {
  const Graph& graph = f.graph;
  std::vector<View> views(graph.size());
  ViewRules rules{graph};
  std::vector<View> args;
  for (std::uint32_t i = 0; i < graph.size(); ++i) {
    const Id id{i};
    const Node node = graph[id];
    if (!node.type.is_real()) continue;
    if (const auto number = graph.number(id); number && std::isfinite(*number)) {
      views[i] = constant(*number);
      continue;
    }
    args.clear();
    for (const Id arg : node.args) args.push_back(views[arg.index]);
    if (info(node.op).kind != OpKind::structure)
      if (const auto view = apply(rules, node.op, std::span<const View>(args))) views[i] = *view;
    if (!views[i] || views[i]->parts.size() > most_atoms)
      views[i] = SumOfPolynomials{BigInterval(0), {{id, {BigInterval(1)}}}};
  }
  return {views.begin(), views.end()};
}

}  // namespace imp
