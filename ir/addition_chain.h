// Addition chains: which products make an integer power.
#pragma once

#include <cstdint>

namespace imp {

// x^n = x^left x^right, with left + right = n.
struct PowerSplit {
  std::uint32_t left, right;  // left >= right >= 1
};

// How x^n is made, for n >= 2. A power is the same product wherever it occurs, so powers of one base share
// what they have in common. Up to n = 128 there are as few products as can be (Knuth 1997, §4.6.3);
// beyond, never more than squaring from the highest bit down takes. Where there is a choice, squares.
PowerSplit split_power(std::uint32_t n);

// x^n for n >= 1 of anything that has a product.
template <class T, class Product>
T positive_power(T x, std::uint32_t n, Product product) {
  if (n == 1) return x;
  const auto [left, right] = split_power(n);
  const T factor = positive_power(x, left, product);
  return product(factor, left == right ? factor : positive_power(x, right, product));
}

}  // namespace imp
