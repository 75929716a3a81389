// Formulas of x and y, and what they are as Programs.
#pragma once

#include <functional>

#include "tests/support/make.h"

namespace imp::test {

using Formula = std::function<Expr(Expr x, Expr y)>;

struct NamedFormula {
  const char* name;
  Formula build;
};

inline Program program_of(const Formula& formula) {
  Program f{.name = "f"};
  const Expr x = input(f, "x", f64), y = input(f, "y", f64);
  output(f, "f", formula(x, y));
  return f;
}

}  // namespace imp::test
