// Random formulas of which parts have no value somewhere, in places where a careless rewrite loses them: u^0,
// T_0(u), 0 u, u - u, u/u, choices between equals, Chebyshev polynomials that are written out.
#pragma once

#include <iterator>

#include "ir/expr.h"
#include "ir/program.h"
#include "tests/support/random.h"

namespace imp::test {

class RandomDomains {
 public:
  explicit RandomDomains(std::uint64_t seed) : random_(seed) {}

  // Of x and y, and z and a parameter a that few use.
  Program build(int depth) {
    program_.name = "domains";
    for (const char* name : {"x", "y", "z"})
      inputs_.push_back({&program_.graph, add_input(program_, name, f64, Rate::ray)});
    inputs_.push_back({&program_.graph, add_input(program_, "a", f64, Rate::frame)});
    program_.outputs = {{"f", sum(depth).id}};
    return std::move(program_);
  }

 private:
  Expr sum(int depth) {
    Expr result = term(depth);
    for (std::size_t i = 0, n = random_.below(4); i < n; ++i)
      result = random_.one_in(3) ? result - term(depth) : result + term(depth);
    return result;
  }

  Expr term(int depth) {
    const Expr u = part(depth);
    switch (random_.below(5)) {
      case 0:  return constant() * u;
      case 1:  return u * part(depth);
      case 2:  return written_out(u);
      default: return u;
    }
  }

  // T_3(u) or T_4(u), scaled.
  Expr written_out(Expr u) {
    const double scale = random_.one_in(2) ? 1 : 0.5;
    if (random_.one_in(2)) return 4.0 * scale * power(u, 3) - 3.0 * scale * u;
    return 8.0 * scale * power(u, 4) - 8.0 * scale * power(u, 2);
  }

  Expr part(int depth) {
    if (depth == 0) return leaf();
    const Expr u = random_.one_in(3) ? sum(depth - 1) : partial(part(depth - 1));
    switch (random_.below(14)) {
      case 0:
      case 1:
      case 2:  return power(u, 0);
      case 3:
      case 4:  return chebyshev(u, 0, 0);
      case 5:  return chebyshev(u, 1, 1);
      case 6:  return 0.0 * u;
      case 7:  return u - u;
      case 8:  return u / u;
      case 9:  return select(u < 0.5, u, u);
      case 10: return min(u, u);
      case 11: return max(u, leaf());
      case 12: return min(leaf(), u);
      default: return u;
    }
  }

  // Not defined everywhere.
  Expr partial(Expr u) {
    switch (random_.below(8)) {
      case 0:
      case 1:  return 1.0 / u;
      case 2:
      case 3:  return make(Op::log, u);
      case 4:  return sqrt(u);
      case 5:  return make(Op::acos, u);
      case 6:  return power(u, -1 - static_cast<double>(random_.below(3)));
      default: return make(Op::pow, u, constant_like(u, 0.5));
    }
  }

  Expr leaf() {
    if (random_.one_in(4)) return constant();
    const Expr input = inputs_[random_.one_in(5) ? random_.below(inputs_.size()) : random_.below(2)];
    return random_.one_in(3) ? input - constant() : input;
  }

  Expr constant() {
    static constexpr double numbers[] = {0, 0, 1, 2, -1, 0.5, 5, -3};
    return constant_like(inputs_[0], numbers[random_.below(std::size(numbers))]);
  }

  static Expr power(Expr u, double n) { return make(Op::powi, u, constant_like(u, n)); }
  static Expr chebyshev(Expr u, double n, double order) {
    return make(Op::chebyshev, u, constant_like(u, n), constant_like(u, order));
  }

  Random random_;
  Program program_;
  std::vector<Expr> inputs_;
};

inline Program random_domains(std::uint64_t seed, int depth) { return RandomDomains(seed).build(depth); }

}  // namespace imp::test
