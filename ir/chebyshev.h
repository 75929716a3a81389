// Chebyshev polynomials of the first kind and their derivatives, by doubling:
//
//   T_0 = 1   T_1 = x   T_2k = 2 T_k^2 - 1   T_2k+1 = 2 T_k T_k+1 - x
//
// in Taylor coefficients, over any kind of number with + - *: floats, nodes, bounds. About 3 log2(n)
// products and as many sums; docs/decisions/chebyshev.md compares it with other ways.
#pragma once

#include <algorithm>
#include <map>
#include <vector>

namespace imp {

inline constexpr double largest_chebyshev_degree = 1 << 20;
inline constexpr double largest_chebyshev_order = 8;  // of derivatives

template <class T, class Constant>
class ChebyshevSeries {
 public:
  // Up to the derivative of that order; `constant(c)` is the number c.
  ChebyshevSeries(const T& x, unsigned order, Constant constant)
      : x_(x), order_(order), one_(constant(1)), constant_(constant) {}

  // The derivative of that order of T_n, order <= n.
  T derivative(unsigned n) {
    double factorial = 1;
    for (unsigned i = 2; i <= order_; ++i) factorial *= i;
    const T& coefficient = of_degree(n)[order_];
    return order_ < 2 ? coefficient : constant_(factorial) * coefficient;
  }

 private:
  // The coefficients up to the order, none beyond the degree: so no factor is a zero.
  using Series = std::vector<T>;

  const Series& of_degree(unsigned n) {
    if (const auto known = series_.find(n); known != series_.end()) return known->second;
    Series result;
    if (n < 2) {
      result.push_back(n == 0 ? one_ : x_);
      if (n == 1 && order_ > 0) result.push_back(one_);
    } else if (n % 2 == 0) {
      const Series& half = of_degree(n / 2);
      for (unsigned k = 0; k <= std::min(order_, n); ++k) result.push_back(twice(square(half, k)));
      result[0] = result[0] - one_;
    } else {
      const Series &below = of_degree(n / 2), &above = of_degree(n / 2 + 1);
      for (unsigned k = 0; k <= std::min(order_, n); ++k) result.push_back(twice(product(below, above, k)));
      result[0] = result[0] - x_;
      if (order_ > 0) result[1] = result[1] - one_;
    }
    return series_.emplace(n, std::move(result)).first->second;
  }

  static T twice(const T& a) { return a + a; }

  // The coefficient k of a b.
  static T product(const Series& a, const Series& b, std::size_t k) {
    std::size_t i = k < b.size() ? 0 : k - (b.size() - 1);
    T sum = a[i] * b[k - i];
    for (++i; i <= k && i < a.size(); ++i) sum = sum + a[i] * b[k - i];
    return sum;
  }

  // The coefficient k of a^2, with each mixed product once.
  static T square(const Series& a, std::size_t k) {
    if (k == 0) return a[0] * a[0];
    std::size_t i = k < a.size() ? 0 : k - (a.size() - 1);
    if (2 * i == k) return a[i] * a[i];
    T sum = a[i] * a[k - i];
    for (++i; 2 * i < k; ++i) sum = sum + a[i] * a[k - i];
    return 2 * i == k ? twice(sum) + a[i] * a[i] : twice(sum);
  }

  T x_;
  unsigned order_;
  T one_;
  Constant constant_;
  std::map<unsigned, Series> series_;
};

// The derivative of that order of T_n at x; T_n itself for order 0.
template <class T, class Constant>
T chebyshev(const T& x, unsigned n, unsigned order, Constant constant) {
  return ChebyshevSeries<T, Constant>(x, order, constant).derivative(n);
}

}  // namespace imp
