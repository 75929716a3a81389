// Roots between critical points, degree by degree (Yuksel 2022, "High-performance polynomial root finding for graphics").
//
// Between neighbouring zeros of its derivative a polynomial has one root at most, where it changes its sign, and
// Newton's method in that bracket finds it. So the zeros of f^(n-1), which is linear, give those of f^(n-2), …, and those of
// df/ds are the critical points of f. A phase finds the zeros of one derivative, all of them at once.
//
// These are points, and prove nothing. They propose where to split the ray: between them f is monotone, and the signs of
// its Bernstein coefficients mostly prove at once that there is no root, or one (parts/walk.h). Where they do not the
// piece is halved, as in `bernstein`, and so a wrong proposal costs steps, not an answer.
//
// Right for polynomials up to degree 12 with many critical points near the ray; the work is the same for all rays, about
// n^3 ops and some ten steps a derivative, which is more than bisection takes on most surfaces.

#include "ir/loop.h"
#include "runtime/search/parts/walk.h"

namespace imp {
namespace {

constexpr std::uint32_t highest_degree = 12;
constexpr double precise_enough = 0x1p-16;  // of a place to split at

using Numbers = std::vector<Expr>;

// In powers of s, from the Bernstein coefficients: the differences at the start, times binomials.
Numbers in_powers(Numbers differences) {
  Numbers result;
  const std::size_t n = differences.size() - 1;
  double binomial = 1;
  for (std::size_t k = 0; k <= n; ++k) {
    result.push_back(binomial * differences[0]);
    for (std::size_t i = 0; i + 1 < differences.size(); ++i)
      differences[i] = differences[i + 1] - differences[i];
    differences.pop_back();
    binomial = binomial * static_cast<double>(n - k) / static_cast<double>(k + 1);
  }
  return result;
}

// Of k! f^(k) what counts: the same zeros.
Numbers derivative(const Numbers& p) {
  Numbers result;
  for (std::size_t i = 1; i < p.size(); ++i) result.push_back(static_cast<double>(i) * p[i]);
  return result;
}

Expr value(const Numbers& p, Expr s) {
  Expr result = p.back();
  for (std::size_t i = p.size() - 1; i-- > 0;) result = fma(result, s, p[i]);
  return result;
}

// Between neighbouring `ends`, ascending, the zero of p where it changes its sign, else the right end: ascending again.
Numbers zeros_between(Program& program, const Numbers& p, const Numbers& ends, Truth enter) {
  const Numbers slope = derivative(p);
  Loop loop(program, "degree" + std::to_string(p.size() - 1), 40);
  std::vector<Expr> states;
  Truth again = truth_of(program.graph, false);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const std::string name = std::to_string(i);
    const Expr start = value(p, ends[i]);
    const Truth changes = start * value(p, ends[i + 1]) < 0;
    const Expr lo = loop.state("lo" + name, select(changes, ends[i], ends[i + 1]));
    const Expr hi = loop.state("hi" + name, ends[i + 1]);
    const Expr s = loop.state("s" + name, select(changes, 0.5 * (ends[i] + ends[i + 1]), ends[i + 1]));

    const Expr at = value(p, s);
    const Truth right = at * start > 0;
    const Expr next_lo = select(right, s, lo), next_hi = select(right, hi, s);
    const Expr newton = s - at / value(slope, s);
    const Truth inside = next_lo < newton && newton < next_hi;
    const Expr next = select(inside, newton, 0.5 * (next_lo + next_hi));
    loop.next(lo, next_lo);
    loop.next(hi, next_hi);
    loop.next(s, next);
    again = again || (abs(next - s) > precise_enough && next_hi - next_lo > precise_enough);
    states.push_back(s);
  }
  loop.enter_if(enter);
  loop.again_while(again);
  for (Expr& state : states) state = loop.result(state);
  return states;
}

// The critical points of p within (0, 1), ascending, and some places beside.
Numbers critical_points(Program& program, const Numbers& p, Truth enter) {
  std::vector<Numbers> derivatives{p};
  while (derivatives.back().size() > 2) derivatives.push_back(derivative(derivatives.back()));
  Numbers found;
  for (std::size_t i = derivatives.size(); i-- > 1;) {
    Numbers ends{zero(p[0])};
    ends.insert(ends.end(), found.begin(), found.end());
    ends.push_back(one(p[0]));
    found = zeros_between(program, derivatives[i], ends, enter);
  }
  return found;
}

}  // namespace

std::optional<Found> polynomial(Program& program, const RayFunction& f, const SearchLimits& limits,
                                Diagnostics& diagnostics) {
  const auto degree = f.degree(diagnostics);
  if (!degree) return std::nullopt;
  if (degree->degree > highest_degree) {
    diagnostics.error(degree->span, "this polynomial is of degree " + std::to_string(degree->degree) +
                                        ", and --search=polynomial takes degrees up to " +
                                        std::to_string(highest_degree) +
                                        "; use --search=bernstein or stackless");
    return std::nullopt;
  }
  const auto places = [&](std::span<const Interval> coefficients) {
    Numbers middles;
    for (const Interval& b : coefficients) middles.push_back(0.5 * (b.hi - b.nlo));
    return critical_points(program, in_powers(middles), f.exists);
  };
  return walk(program, f, limits, diagnostics, places);
}

}  // namespace imp
