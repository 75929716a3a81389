#include "passes/extend/chebyshev_extremes.h"

#include <cmath>
#include <numbers>

#include "ir/assert.h"
#include "ir/chebyshev.h"
#include "passes/multiprecision.h"

namespace imp {
namespace {

// Beyond what std::cos and the bisection are off.
constexpr double slack = 0x1p-44;

BigInterval derivative(const BigInterval& x, unsigned n, unsigned k) {
  return chebyshev(x, n, k, [](double c) { return BigInterval(c); });
}

// The derivative of order k of T_n but for a positive factor: Gegenbauer's polynomial, by its recurrence.
// A guess: what it finds is proven.
double guess(double x, unsigned n, unsigned k) {
  double before = 0, value = 1;
  for (unsigned m = 1; m <= n - k; ++m) {
    const double next = (2 * x * (m + k - 1) * value - (m + 2.0 * k - 2) * before) / m;
    before = value;
    value = next;
  }
  return value;
}

// [left, right] around the root of the derivative of order k between a < b.
double root_between(double a, double b, unsigned n, unsigned k) {
  const bool rises = guess(a, n, k) < 0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (a + b);
    ((guess(middle, n, k) < 0) == rises ? a : b) = middle;
  }
  return 0.5 * (a + b);
}

// The positive roots of the derivative of order k >= 2, largest first. Neighbours are more than half of
// pi/n apart as angles.
std::vector<double> positive_roots(unsigned n, unsigned k) {
  std::vector<double> roots;
  const unsigned parts = 4 * n;
  const auto place = [&](unsigned i) { return std::cos(std::numbers::pi / 2 * i / parts); };
  for (unsigned i = 0; i < parts; ++i) {
    const double right = place(i), left = i + 1 == parts ? slack : place(i + 1);
    if ((guess(left, n, k) < 0) != (guess(right, n, k) < 0)) roots.push_back(root_between(left, right, n, k));
  }
  return roots;
}

bool changes_sign(double left, double right, unsigned n, unsigned k) {
  const BigInterval a = derivative(left, n, k), b = derivative(right, n, k);
  return !a.holds_zero() && !b.holds_zero() && mpfr_sgn(a.lo()) != mpfr_sgn(b.lo());
}

}  // namespace

std::vector<ChebyshevExtreme> chebyshev_extremes(unsigned n, unsigned k) {
  std::vector<ChebyshevExtreme> extremes;
  if (k == 0) {  // at cos(j pi/n), where it is 1 or -1
    for (unsigned j = 1; j <= n / 2; ++j) {
      const double x = 2 * j == n ? 0 : std::cos(std::numbers::pi * j / n), value = j % 2 == 0 ? 1 : -1;
      extremes.push_back({std::fmax(0, x - slack), x + slack, value, value});
    }
    return extremes;
  }
  std::vector<double> roots = positive_roots(n, k + 1);
  const unsigned degree = n - k - 1;
  IMP_ASSERT(roots.size() == degree / 2, "as many roots as the degree says");
  if (degree % 2 == 1) roots.push_back(0);
  for (const double root : roots) {
    const double left = root == 0 ? 0 : root - slack, right = root == 0 ? 0 : root + slack;
    IMP_ASSERT(root == 0 || changes_sign(left, right, n, k + 1), "a root in its bracket");
    const BigInterval value = derivative({left, right}, n, k);
    extremes.push_back({left, right, mpfr_get_d(value.lo(), MPFR_RNDD), mpfr_get_d(value.hi(), MPFR_RNDU)});
  }
  return extremes;
}

}  // namespace imp
