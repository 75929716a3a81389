// A question that is answered wrong, made as short as it may be while the answer stays wrong.
#pragma once

#include <functional>

#include "tests/support/attack_case.h"

namespace imp::test {

class Minimiser {
 public:
  explicit Minimiser(AttackCase wrong, std::size_t tries = 300) : best_(std::move(wrong)), tries_(tries) {}

  AttackCase operator()() {
    while (step()) {}
    return best_;
  }

 private:
  bool accept(AttackCase candidate) {
    if (tries_ == 0 || to_text(candidate) == to_text(best_)) return false;
    --tries_;
    if (!is_wrong(candidate)) return false;
    best_ = std::move(candidate);
    return true;
  }
  bool step() { return drop_statements() || shrink_formulas() || drop_options() || round_numbers(); }

  bool drop_statements() {
    for (std::size_t i = 0; best_.scene.surfaces.size() > 1 && i < best_.scene.surfaces.size(); ++i) {
      AttackCase next = best_;
      next.scene.surfaces.erase(next.scene.surfaces.begin() + static_cast<std::ptrdiff_t>(i));
      if (accept(next)) return true;
    }
    for (std::size_t i = 0; i < best_.scene.params.size(); ++i) {
      AttackCase next = best_;
      next.scene.params.erase(next.scene.params.begin() + static_cast<std::ptrdiff_t>(i));
      if (accept(next)) return true;
    }
    if (!best_.scene.time) return false;
    AttackCase next = best_;
    next.scene.time.reset();
    return accept(next);
  }

  // Every part replaced by one of its own, or by something simple.
  bool shrink_formulas() {
    for (std::size_t s = 0; s < best_.scene.surfaces.size(); ++s)
      for (std::size_t i = 0; i < size(best_.scene.surfaces[s]); ++i) {
        AttackCase next = best_;
        std::size_t at = i;
        const Expression original = part(next.scene.surfaces[s], at);
        std::vector<Expression> simpler(original.args.begin(), original.args.end());
        if (original.is_number() && original.name.size() > 1)
          for (const char* digits : {"0", "1", "2"}) simpler.push_back({digits});
        if (original.is_number() && original.name.size() > 3)
          simpler.push_back({fmt::format("{:.2g}", std::stod(original.name))});
        if (!original.args.empty())
          for (const char* leaf : {"0", "1", "x"}) simpler.push_back({leaf});
        for (Expression& e : simpler) {
          at = i;
          next = best_;
          part(next.scene.surfaces[s], at) = std::move(e);
          if (accept(next)) return true;
        }
      }
    return false;
  }
  static Expression& part(Expression& e, std::size_t& at) {  // by its place in the tree
    if (at == 0) return e;
    Expression* found = nullptr;
    for (Expression& arg : e.args) {
      if (found != nullptr) break;
      --at;
      Expression& there = part(arg, at);
      if (at == 0) found = &there;
    }
    return found != nullptr ? *found : e;
  }

  bool drop_options() {
    const AttackOptions usual;
    AttackCase next = best_;
    next.options.search = usual.search;
    if (accept(next)) return true;
    next = best_, next.options.inclusion = usual.inclusion;
    if (accept(next)) return true;
    next = best_, next.options.kernel.precision = usual.kernel.precision;
    if (accept(next)) return true;
    next = best_, next.options.kernel.backend = usual.kernel.backend;
    if (accept(next)) return true;
    next = best_, next.options.kernel.target = usual.kernel.target;
    if (accept(next)) return true;
    next = best_, next.options.tiles = usual.tiles;
    if (accept(next)) return true;
    next = best_, next.options.economize = usual.economize;
    return accept(next);
  }

  bool round_numbers() {
    for (std::size_t i = 0; i < best_.numbers.size(); ++i) {
      const double x = best_.numbers[i];
      std::vector<double> simpler;
      if (best_.asked == Asked::picture) simpler = {8};
      if (x != 0) simpler.push_back(0);
      if (x != 0 && std::abs(x) != 1) simpler.push_back(std::copysign(1, x));
      for (const int digits : {1, 2, 4})
        if (const std::string text = fmt::format("{:.{}g}", x, digits);
            text.size() < fmt::format("{}", x).size())
          simpler.push_back(std::stod(text));
      for (const double y : simpler) {
        AttackCase next = best_;
        next.numbers[i] = y;
        if (is_question(next) && accept(next)) return true;
      }
    }
    return false;
  }
  static bool is_question(const AttackCase& attack) {
    const auto& n = attack.numbers;
    if (attack.asked == Asked::ray) return n[6] <= n[7];
    if (attack.asked == Asked::picture) return n[0] >= 1;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t point = 6; point < n.size(); point += 3)
        if (!(n[2 * i] <= n[point + i] && n[point + i] <= n[2 * i + 1])) return false;
    return true;
  }

  AttackCase best_;
  std::size_t tries_;
};

inline AttackCase minimised(const AttackCase& wrong, std::size_t tries = 300) {
  return Minimiser(wrong, tries)();
}

}  // namespace imp::test
