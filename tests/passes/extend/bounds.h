// What the extension of a formula of x and y says of a box.
#pragma once

#include <array>

#include "tests/support/boxes.h"
#include "tests/support/evaluate.h"

namespace imp::test {

struct Bounds {
  double lo, hi;
  bool defined;
  double width() const { return hi - lo; }
};

inline Bounds bounds_over(const Kernel& extension, Box1 x, Box1 y) {
  const auto v = evaluate(extension, std::array{x.lo, x.hi, y.lo, y.hi});
  return {v[0], v[1], v[2] != 0};
}

}  // namespace imp::test
