// Random intervals with values at their ends, where bugs live.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "ir/infinity.h"
#include "tests/support/random.h"

namespace imp::test {

struct Box1 {
  double lo, hi;
};

inline std::string to_text(Box1 box) { return fmt::format("[{}, {}]", box.lo, box.hi); }

class Boxes {
 public:
  explicit Boxes(std::uint64_t seed) : random_(seed) {}

  // Magnitudes 1e-6 to 1e6, widths from zero to huge; one in four has an end at 0, at infinity, or
  // among the denormals, huge numbers, integers.
  Box1 box() {
    if (pick(4) == 0) {
      const double a = special(), b = special();
      return a <= b ? repaired({a, b}) : repaired({b, a});
    }
    const double mid = (pick(2) ? 1 : -1) * std::pow(10.0, between(-6, 6));
    const double half = std::abs(mid) * std::array{0.0, 1e-6, 1e-2, 1.0, 4.0}[pick(5)];
    return {mid - half, mid + half};
  }

  Box1 within(double lo, double hi) {
    const double width = (hi - lo) * std::exp2(-between(0, 20)), mid = between(lo, hi);
    return {std::max(lo, mid - width / 2), std::min(hi, mid + width / 2)};
  }

  double inside(Box1 box) {
    switch (pick(4)) {
      case 0:  return finite(box.lo);
      case 1:  return finite(box.hi);
      case 2:  return box.lo <= 0 && 0 <= box.hi ? 0.0 : finite(box.lo);
      default: return between(finite(box.lo), finite(box.hi));
    }
  }

  double between(double a, double b) { return std::min(b, a + random_.unit() * (b - a)); }
  std::size_t pick(std::size_t n) { return random_.below(n); }

 private:
  static double finite(double x) { return std::isinf(x) ? std::copysign(1e300, x) : x; }

  // An interval of reals: not [inf, inf].
  static Box1 repaired(Box1 box) {
    if (box.lo == infinity) box.lo = 1e300;
    if (box.hi == -infinity) box.hi = -1e300;
    return box;
  }

  double special() {
    static constexpr double values[] = {
        0.0,  -0.0,  1,     -1,     2,      -2,     3,        0.5,       1e-40, -1e-40, 5e-324, 1e38, -1e38,
        4e38, -4e38, 1e300, -1e300, 1e-310, 0x1p24, infinity, -infinity, 0.1,   -0.1,   1e-60,  1.5,  -1.5};
    return values[pick(std::size(values))];
  }

  Random random_;
};

}  // namespace imp::test
