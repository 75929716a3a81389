// Random formulas that are polynomials in x, y, z, with a parameter w and constants as coefficients.
#pragma once

#include "tests/support/make.h"
#include "tests/support/random.h"

namespace imp::test {

class RandomPolynomial {
 public:
  RandomPolynomial(std::uint64_t seed, std::uint32_t degree) : random_(seed), f_{.name = "f"} {
    for (const char* name : {"x", "y", "z"}) variables_.push_back(input(f_, name, f64));
    variables_.push_back(input(f_, "w", f64, Rate::frame));
    output(f_, "f", polynomial(degree));
  }

  // Inputs x, y, z and w; as written, of the degree asked for, at most.
  const Program& program() const { return f_; }

 private:
  Expr polynomial(std::uint32_t degree) {
    if (degree == 0) return coefficient();
    if (degree == 1) return linear();
    const auto lower = static_cast<std::uint32_t>(1 + random_.below(degree - 1));
    switch (random_.below(6)) {
      case 0:
        for (std::uint32_t n = degree; n > 1; --n)
          if (degree % n == 0 && random_.below(2) == 0) return power(polynomial(degree / n), n);
        return power(variables_[random_.below(3)], degree) + polynomial(lower);
      case 1: {
        const Expr a = polynomial((degree + 1) / 2);
        return degree % 2 == 0 ? a * a - coefficient() : a * polynomial(degree / 2);
      }
      case 2:  return polynomial(degree) + polynomial(lower);
      case 3:  return fma(polynomial(degree - lower), polynomial(lower), polynomial(lower));
      case 4:  return polynomial(lower) - polynomial(degree) / 3.0;
      default: return polynomial(lower) * polynomial(degree - lower);
    }
  }

  Expr linear() {
    Expr sum = coefficient();
    for (std::size_t i = 0; i < 3; ++i)
      if (random_.below(2) == 0) sum = sum + coefficient() * variables_[i];
    return random_.below(3) == 0 ? -sum : sum + variables_[random_.below(3)];
  }

  Expr coefficient() {
    const auto number = [&](double value) { return constant_like(variables_[0], value); };
    switch (random_.below(6)) {
      case 0:  return number(static_cast<double>(1 + random_.below(9))) / number(10);
      case 1:  return number(-1);
      case 2:  return number(static_cast<double>(random_.below(4)));
      case 3:  return variables_[3] * variables_[3];
      case 4:  return number(0.5) - variables_[3];
      default: return number(random_.between(-2, 2));
    }
  }

  Random random_;
  Program f_;
  std::vector<Expr> variables_;
};

}  // namespace imp::test
