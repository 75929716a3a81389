// The numbers where ops go wrong: zeros of both signs, the ends of the ranges, denormals, halves and
// their neighbours, multiples of pi, infinities, NaN.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace imp::test {

template <class T>
std::vector<T> interesting_values() {
  using Limits = std::numeric_limits<T>;
  const T next_to_one = std::nextafter(T(1), T(0));
  std::vector<T> values{T(0),
                        T(1),
                        T(2),
                        T(3),
                        T(10),
                        T(0.1),
                        T(0.5),
                        T(1.5),
                        T(2.5),
                        T(1) / T(3),
                        next_to_one,
                        T(1) + Limits::epsilon(),
                        std::nextafter(T(0.5), T(0)),
                        std::numbers::pi_v<T>,
                        std::numbers::pi_v<T> / 2,
                        T(100) * std::numbers::pi_v<T>,
                        std::numbers::e_v<T>,
                        T(127),
                        T(128),
                        T(149),
                        T(150),
                        T(161),
                        T(1022),
                        T(1023),
                        T(1024),
                        T(1074),
                        T(1075),
                        T(1101),
                        T(2200),
                        T(5000),
                        T(1e4),
                        T(8388607.5),
                        T(16777216),
                        T(1e-6),
                        T(1e-20),
                        T(1e20),
                        std::sqrt(Limits::max()),
                        Limits::min(),
                        Limits::min() / 2,
                        std::nextafter(Limits::min(), T(0)),
                        Limits::denorm_min(),
                        3 * Limits::denorm_min(),
                        Limits::max(),
                        Limits::max() / 2,
                        Limits::infinity()};
  for (std::size_t i = 0, n = values.size(); i < n; ++i) values.push_back(-values[i]);
  values.push_back(Limits::quiet_NaN());
  return values;
}

}  // namespace imp::test
