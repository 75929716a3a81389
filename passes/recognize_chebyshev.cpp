#include "passes/recognize_chebyshev.h"

#include "ir/chebyshev.h"
#include "ir/expr.h"
#include "passes/rewrite.h"
#include "passes/sum_of_polynomials.h"

namespace imp {
namespace {

constexpr std::size_t most_atoms_of_a_sum = 32;  // in one sum
constexpr std::size_t longest_formula = 10'000;  // nodes; in longer ones looking takes seconds

// scale T_degree(u) + rest.
struct Match {
  double scale;
  unsigned degree;
  BigInterval rest;
};

// A coefficient that 160 bits do not hold is no double either.
std::optional<double> exact_double(const BigInterval& a) {
  const double value = mpfr_get_d(a.lo(), MPFR_RNDN);
  return a.is(value) ? std::optional(value) : std::nullopt;
}

// The coefficients of T_n, of the powers 0 to n.
std::vector<BigInterval> chebyshev_coefficients(std::size_t n) {
  std::vector<BigInterval> before{1}, current{0, 1};
  for (std::size_t m = 1; m < n; ++m) {
    std::vector<BigInterval> next(m + 2, BigInterval(0));
    for (std::size_t i = 0; i <= m; ++i) next[i + 1] = BigInterval(2) * current[i];
    for (std::size_t i = 0; i < m; ++i) next[i] = next[i] - before[i];
    before = std::move(current);
    current = std::move(next);
  }
  return current;
}

// Every polynomial of degree 1 or 2 without a linear term is one: not worth the name.
std::optional<Match> match(const Coefficients& c) {
  const std::size_t n = c.size();
  if (n < 3) return std::nullopt;
  // Most are not: the two leading coefficients tell.
  if (const BigInterval d = BigInterval(4) * c[n - 3] + BigInterval(double(n)) * c[n - 1]; !d.is(0))
    return std::nullopt;
  const auto t = chebyshev_coefficients(n);
  BigInterval scale;
  mpfi_div(scale, c[n - 1], t[n]);
  const auto exact = exact_double(scale);
  if (!exact) return std::nullopt;
  for (std::size_t i = 1; i < n; ++i)
    if (const BigInterval d = c[i - 1] - scale * t[i]; !d.is(0)) return std::nullopt;
  return Match{*exact, static_cast<unsigned>(n), BigInterval(0) - scale * t[0]};
}

Expr times(double factor, Expr a) { return factor == 1 ? a : factor == -1 ? -a : factor * a; }

// The sum over the op, where `now` has the atoms. Nothing if it has a part that is no Chebyshev polynomial.
std::optional<Expr> rebuilt(Graph& graph, const SumOfPolynomials& sum, const std::vector<Id>& now) {
  std::optional<Expr> result;
  bool found = false;
  BigInterval constant = sum.constant;
  for (const auto& [atom, coefficients] : sum.parts) {
    Expr term{&graph, now[atom.index]};
    if (coefficients.size() == 1) {
      const auto factor = exact_double(coefficients[0]);
      if (!factor) return std::nullopt;
      term = times(*factor, term);
    } else {
      const auto m = match(coefficients);
      if (!m) return std::nullopt;
      constant = constant + m->rest;
      term = times(m->scale, make(Op::chebyshev, term, constant_like(term, m->degree), zero(term)));
      found = true;
    }
    result = result ? *result + term : term;
  }
  const auto rest = exact_double(constant);
  if (!found || !rest) return std::nullopt;
  return *rest == 0 ? *result : *rest < 0 ? *result - -*rest : *result + *rest;
}

}  // namespace

// With sums looked into, T_6(x) + T_6(y) is found where it is one long sum; without, T_6(x + y).
Program recognize_chebyshev(const Program& f) {
  if (f.graph.size() > longest_formula) return f;
  const auto parts = sums_of_polynomials(f, most_atoms_of_a_sum), wholes = sums_of_polynomials(f, 1);
  std::vector<Id> now(f.graph.size());
  return rewrite(f, [&](Graph& graph, Id old, const Node& node) {
    Id& result = now[old.index];
    result = copy(graph, node);
    for (const auto* views : {&parts, &wholes}) {
      const auto& view = (*views)[old.index];
      if (!view || node.op == Op::constant || view->parts.contains(old)) continue;
      if (const auto better = rebuilt(graph, *view, now)) return result = better->id;
    }
    return result;
  });
}

}  // namespace imp
