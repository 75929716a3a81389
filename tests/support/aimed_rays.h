// Rays at a place where it is hard, at any zoom.
#pragma once

#include "tests/support/cast.h"
#include "tests/support/random.h"

namespace imp::test {

// Segments of length 6 scale around `place`: most pass it closely, by 2^-k of scale.
inline std::vector<Ray> rays_at(const std::array<double, 3>& place, double scale, std::size_t count,
                                std::uint64_t seed) {
  Random random(seed);
  std::vector<Ray> rays;
  while (rays.size() < count) {
    Ray ray{{}, {}, 0, 6 * scale};
    double square = 0;
    for (double& x : ray.d) {
      x = random.between(-1, 1);
      square += x * x;
    }
    if (square > 1 || square < 0.01) continue;
    const double aside = std::ldexp(scale, -static_cast<int>(random.below(24)));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ray.d[axis] /= std::sqrt(square);
      ray.o[axis] = place[axis] + random.between(-aside, aside) - 3 * scale * ray.d[axis];
    }
    rays.push_back(ray);
  }
  return rays;
}

}  // namespace imp::test
