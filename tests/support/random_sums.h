// Random formulas that are sums of products, some of them shared, with factored forms and constants among them.
#pragma once

#include "ir/expr.h"
#include "ir/program.h"
#include "tests/support/random.h"

namespace imp::test {

class RandomSums {
 public:
  explicit RandomSums(std::uint64_t seed) : random_(seed) {}

  Program build() {
    program_.name = "polynomial";
    for (const char* name : {"x", "y", "z"})
      known_.push_back({&program_.graph, add_input(program_, name, f64, Rate::ray)});
    known_.push_back({&program_.graph, add_input(program_, "a", f64, Rate::frame)});
    for (std::size_t i = 0, n = random_.below(3); i < n; ++i) known_.push_back(sum(2));
    for (std::size_t i = 0, n = 1 + random_.below(2); i < n; ++i)
      program_.outputs.push_back({"f" + std::to_string(i), sum(3).id});
    return std::move(program_);
  }

 private:
  Expr sum(std::size_t depth) {
    Expr result = term(depth);
    for (std::size_t i = 0, n = 1 + random_.below(6); i < n; ++i) {
      const Expr next = random_.one_in(12) && depth > 0 ? sum(depth - 1) : term(depth);
      result = random_.one_in(3) ? result - next : random_.one_in(4) ? next + result : result + next;
    }
    return random_.one_in(10) ? -result : result;
  }

  Expr term(std::size_t depth) {
    Expr result = random_.one_in(2) ? factor(depth) : constant();
    for (std::size_t i = 0, n = random_.below(4); i < n; ++i) result = result * factor(depth);
    if (random_.one_in(8)) result = -result;
    return random_.one_in(8) ? result / constant() : result;
  }

  Expr factor(std::size_t depth) {
    if (depth > 0 && random_.one_in(10)) return sum(depth - 1);
    const Expr base = known_[random_.below(known_.size())];
    switch (random_.below(8)) {
      case 0:  return abs(base);
      case 1:  return 1.0 / (base * base + 1.0);
      case 2:
      case 3:
      case 4:  return make(Op::powi, base, constant_like(base, static_cast<double>(1 + random_.below(5))));
      default: return base;
    }
  }

  Expr constant() {
    const Expr like = known_[0];
    static constexpr double numbers[] = {1, 2, -1, -3, 0.5, 5, 10, 7};
    const Expr number = constant_like(like, numbers[random_.below(std::size(numbers))]);
    if (random_.one_in(4)) return sqrt(constant_like(like, 5));
    return random_.one_in(4) ? number / 3.0 : number;
  }

  Random random_;
  Program program_;
  std::vector<Expr> known_;
};

inline Program random_sums(std::uint64_t seed) { return RandomSums(seed).build(); }

}  // namespace imp::test
