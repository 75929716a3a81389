#include "passes/polynomial/basis.h"

#include <cmath>
#include <numbers>

#include "ir/assert.h"

namespace imp {
namespace {

BigInterval binomial(std::uint32_t n, std::uint32_t k) {
  return falling_factorial(n, k) / falling_factorial(k, k);
}

// The Bernstein coefficients of the polynomial that is 1 at points[j] and 0 at the others: the product of
// (t - t_k)/(t_j - t_k), in which the coefficients scaled by their binomials convolve.
std::vector<BigInterval> cardinal(std::span<const double> points, std::size_t j) {
  std::vector<BigInterval> scaled{1.0};
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (k == j) continue;
    const BigInterval divisor(points[j] - points[k]);  // multiples of 2^-12, and so all of this is exact
    const BigInterval at_zero = BigInterval(-points[k]) / divisor;
    const BigInterval at_one = BigInterval(1 - points[k]) / divisor;
    scaled.emplace_back(0.0);
    for (std::size_t i = scaled.size(); i-- > 0;)
      scaled[i] = scaled[i] * at_zero + (i > 0 ? scaled[i - 1] * at_one : BigInterval(0));
  }
  const auto degree = static_cast<std::uint32_t>(points.size() - 1);
  for (std::uint32_t i = 0; i <= degree; ++i) scaled[i] = scaled[i] / binomial(degree, i);
  return scaled;
}

}  // namespace

std::vector<double> sample_points(std::uint32_t degree) {
  IMP_ASSERT(degree <= 64, "points that differ once rounded");
  std::vector<double> points(degree + 1);
  for (std::uint32_t j = 0; 2 * j <= degree; ++j) {
    const double exact = degree == 0 ? 0.0 : (1 - std::cos(std::numbers::pi * j / degree)) / 2;
    points[degree - j] = 1 - std::round(exact * 0x1p12) * 0x1p-12;
    points[j] = 1 - points[degree - j];
  }
  return points;
}

Matrix from_samples(std::uint32_t degree, Type type) {
  const auto points = sample_points(degree);
  Matrix result(points.size());
  for (std::size_t j = 0; j < points.size(); ++j) {
    const auto column = cardinal(points, j);
    for (std::size_t i = 0; i < points.size(); ++i) result[i].push_back(weight(column[i], type));
  }
  return result;
}

// n!/(n - k)! t^k is the sum of i!/(i - k)! B_i (Seland and Dokken 2007, lemma 1.3).
Matrix from_powers(std::uint32_t degree, Type type) {
  Matrix result(degree + 1);
  for (std::uint32_t i = 0; i <= degree; ++i)
    for (std::uint32_t k = 0; k <= degree; ++k)
      result[i].push_back(weight(falling_factorial(i, k) / falling_factorial(degree, k), type));
  return result;
}

BigInterval falling_factorial(std::uint32_t n, std::uint32_t k) {
  BigInterval result(1);
  for (std::uint32_t i = 0; i < k; ++i) result = result * BigInterval(i < n ? n - i : 0);
  return result;
}

}  // namespace imp
