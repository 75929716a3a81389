// Formulas of two variables put together at random, with constants that overflow, underflow and vanish.
#pragma once

#include <iterator>

#include "ir/expr.h"
#include "tests/support/random.h"

namespace imp::test {

class Composer {
 public:
  Composer(Expr x, Expr y, std::uint64_t seed, bool elementary = false)
      : x_(x), y_(y), random_(seed), elementary_(elementary) {}

  Expr formula(int depth) {
    if (depth == 0) return leaf();
    const auto part = [&] { return formula(depth - 1 - static_cast<int>(random_.below(2)) % depth); };
    const Expr a = part(), b = part();
    switch (random_.below(elementary_ ? 24 : 16)) {
      case 0:
      case 1:  return a + b;
      case 2:  return a - b;
      case 3:
      case 4:
      case 5:  return a * b;
      case 6:
      case 7:  return a / b;
      case 8:  return min(a, b);
      case 9:  return max(a, b);
      case 10: return sqrt(a);
      case 11: return abs(a);
      case 12: return make(Op::powi, a, constant_like(a, static_cast<double>(random_.below(6)) - 2));
      case 13: return make(Op::sign, a);
      case 14: return select(a < b, a, b * 2.0);
      case 15: return floor(a);
      case 16: return make(Op::exp, a);
      case 17: return make(Op::log, a);
      case 18: return make(Op::sin, a);
      case 19: return make(Op::tan, a);
      case 20: return make(Op::acos, a);
      case 21: return make(Op::atanh, a);
      case 22: return make(Op::pow, a, b);
      default: return ceil(a);
    }
  }

 private:
  Expr leaf() {
    static constexpr double constants[] = {
        0, 1, 2, -3, 0.1, 5, 3 * 0x1p-140, 1e-30, 1e30, 3 * 0x1p-1070, 1e300, -1e-40};
    switch (random_.below(3)) {
      case 0:  return x_;
      case 1:  return y_;
      default: return constant_like(x_, constants[random_.below(std::size(constants))]);
    }
  }

  Expr x_, y_;
  Random random_;
  bool elementary_;
};

}  // namespace imp::test
