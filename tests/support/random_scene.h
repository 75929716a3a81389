// Random files for the attack: trees over the whole language, mixed of parts that have been hard.
#pragma once

#include "tests/support/attack_ways.h"
#include "tests/support/random.h"
#include "tests/support/scene.h"

namespace imp::test {

class RandomScenes {
 public:
  explicit RandomScenes(std::uint64_t seed) : random_(seed) {}

  // With one to three surfaces; most have a root near aim().
  Scene next() {
    Scene scene;
    variables_ = {"x", "y", "z", "x", "y", "z"};
    for (double& place : aim_) place = random_.one_in(4) ? 0 : nice(random_.between(-2, 2));
    if (random_.one_in(5)) scene.params.push_back({"a", number(any({"0", "0.5", "1", "2", "0.1", "1e-9"}))});
    if (random_.one_in(12)) scene.time = {"t", number(any({"0", "1", "0.25", "5e6"}))};
    for (const auto& param : scene.params) variables_.push_back(param.name);
    if (scene.time) variables_.push_back(scene.time->name);
    const std::size_t surfaces = random_.one_in(8) ? 2 + random_.below(2) : 1;
    for (std::size_t i = 0; i < surfaces; ++i) scene.surfaces.push_back(through_aim(formula(), scene));
    return scene;
  }
  const std::array<double, 3>& aim() const { return aim_; }

  Expression formula() {
    Expression result = part();
    for (std::size_t i = random_.below(3); i > 0; --i) {
      Expression other = part();
      switch (random_.below(8)) {
        case 0:  result = {"*", {result, other}}; break;
        case 1:  result = {any({"min", "max"}), {result, other}}; break;
        case 2:  result = {"-", {result, other}}; break;
        case 3:  result = {"+", {result, {"*", {number("0"), other}}}}; break;
        default: result = {"+", {result, other}}; break;
      }
    }
    return result;
  }

 private:
  static double nice(double x) { return std::round(x * 100) / 100; }
  static Expression number(std::string text) { return {std::move(text), {}}; }
  static Expression minus(Expression e) { return {"-", {std::move(e)}}; }
  static Expression number(double value) {
    Expression size{fmt::format("{}", std::abs(value)), {}};
    return std::signbit(value) ? minus(size) : size;
  }
  std::string any(std::initializer_list<const char*> words) {
    return words.begin()[random_.below(words.size())];
  }

  // Moved so that it is about 0 at aim().
  Expression through_aim(Expression e, const Scene& scene) {
    if (random_.one_in(4)) return e;
    std::vector<std::string> names{"x", "y", "z"};
    std::vector<RealSet> at;
    for (const double place : aim_) at.push_back({Real(place), Real(place)});
    const auto bind = [&](const Scene::Named& named) {
      names.push_back(named.name);
      const Real value(exact_constant(named.value)->get_d());
      at.push_back({value, value});
    };
    for (const auto& param : scene.params) bind(param);
    if (scene.time) bind(*scene.time);
    const Outcome f = RealFunction(e, names)(at);
    const double value = f.defined ? f.lo.nearest() : NAN;
    if (!std::isfinite(value)) return e;
    const std::string rounded = fmt::format("{:.3g}", value);
    const double offset = random_.one_in(6) ? value : std::stod(rounded);
    return offset == 0 ? e : Expression{"-", {std::move(e), number(offset)}};
  }

  Expression part() {
    switch (random_.below(14)) {
      case 0:
      case 1:  return tree(3);
      case 2:
      case 3:  return polynomial(4);
      case 4:  return {"+", {chebyshev_like(), domain_only()}};
      case 5:  return removable();
      case 6:  return near_double();
      case 7:  return pole();
      case 8:  return far_wave();
      case 9:  return flat();
      case 10: return jump();
      case 11: return power();
      case 12: return {"+", {polynomial(3), domain_only()}};
      default: return series();
    }
  }

  Expression variable() { return {variables_[random_.below(variables_.size())], {}}; }
  Expression constant() {
    switch (random_.below(8)) {
      case 0:  return number(any({"1e20", "1e-20", "1e30", "1e-30", "1e10", "1e-9", "5e6", "1e300"}));
      case 1:  return number(any({"0", "1", "0.1", "0.3", "pi"}));
      case 2:  return minus(number(nice(random_.between(0, 3))));
      case 3:  return {"/", {number(any({"1", "2", "5"})), number(any({"3", "7", "9"}))}};
      default: return number(nice(random_.between(0, 4)));
    }
  }
  Expression linear() {
    Expression e = variable();
    if (random_.one_in(2)) e = {"*", {number(nice(random_.between(0.1, 4))), e}};
    if (random_.one_in(2)) e = {any({"+", "-"}), {e, variable()}};
    if (random_.one_in(2)) e = {any({"+", "-"}), {e, number(nice(random_.between(0, 3)))}};
    return e;
  }
  Expression tree(int depth) {
    if (depth == 0) return random_.one_in(4) ? constant() : random_.one_in(3) ? linear() : variable();
    const auto arg = [&] { return tree(static_cast<int>(random_.below(static_cast<std::size_t>(depth)))); };
    switch (random_.below(16)) {
      case 0:
      case 1:
      case 2:  return {"+", {arg(), arg()}};
      case 3:  return {"-", {arg(), arg()}};
      case 4:
      case 5:
      case 6:  return {"*", {arg(), arg()}};
      case 7:  return {"/", {arg(), arg()}};
      case 8:  return {"^", {arg(), number(any({"2", "3", "4", "5", "1.5", "0.5"}))}};
      case 9:  return {any({"min", "max"}), {arg(), arg()}};
      case 10: return {any({"mod", "atan2"}), {arg(), arg()}};
      case 11: return choice(depth - 1);
      default: return {function(), {arg()}};
    }
  }
  std::string function() {
    return any({"sqrt", "cbrt", "exp",  "log",  "sin",   "cos",   "tan",   "asin", "acos",
                "atan", "sinh", "cosh", "tanh", "asinh", "acosh", "atanh", "abs",  "floor",
                "ceil", "sign", "sqrt", "log",  "sin",   "cos",   "abs"});
  }
  Expression condition(int depth) {
    if (depth > 0 && random_.one_in(4))
      return {any({"and", "or"}), {condition(depth - 1), condition(depth - 1)}};
    if (random_.one_in(8)) return {"not", {condition(0)}};
    return {any({"<", "<=", ">", ">="}), {tree(1), random_.one_in(2) ? number("0") : tree(1)}};
  }
  Expression choice(int depth) {
    const auto arg = [&] { return depth > 0 ? tree(depth) : linear(); };
    return {"if", {condition(1), arg(), arg()}};
  }
  Expression polynomial(std::size_t terms) {
    const auto term = [&] {
      Expression e = variable();
      if (random_.one_in(2)) e = {"^", {e, number(std::to_string(2 + random_.below(5)))}};
      if (random_.one_in(3)) e = {"*", {e, variable()}};
      if (random_.one_in(3)) e = {"*", {constant(), e}};
      return e;
    };
    Expression sum = term();
    for (std::size_t i = random_.below(terms); i > 0; --i) sum = {any({"+", "-"}), {sum, term()}};
    return sum;
  }
  Expression argument() { return random_.one_in(3) ? tree(1) : linear(); }

  Expression chebyshev_like() {
    const Expression u = argument();
    const auto power = [&](const char* n) { return Expression{"^", {u, number(n)}}; };
    const auto times = [&](const char* c, const Expression& e) { return Expression{"*", {number(c), e}}; };
    switch (random_.below(5)) {
      case 0:  return {"-", {times("4", power("3")), times("3", u)}};
      case 1:  return {"-", {times("2", power("2")), number("1")}};
      case 2:  return {"+", {{"-", {times("8", power("4")), times("8", power("2"))}}, number("1")}};
      case 3:  return {"T", {number(std::to_string(random_.below(9))), u}};
      default: return {"+", {{"-", {times("16", power("5")), times("20", power("3"))}}, times("5", u)}};
    }
  }
  // 1 or 0 where it has a value.
  Expression domain_only() {
    const Expression u = argument();
    const Expression part{any({"log", "sqrt", "asin", "atanh", "acosh"}), {u}};
    const Expression inverse{"/", {number("1"), u}};
    switch (random_.below(6)) {
      case 0:  return {"^", {part, number("0")}};
      case 1:  return {"^", {inverse, number("0")}};
      case 2:  return {"T", {number("0"), random_.one_in(2) ? part : inverse}};
      case 3:  return {"*", {number("0"), random_.one_in(2) ? part : inverse}};
      case 4:  return {"-", {part, part}};
      default: return {"/", {part, part}};
    }
  }
  Expression removable() {
    const Expression u = argument(), w = argument();
    const Expression root{"sqrt", {u}};
    switch (random_.below(5)) {
      case 0:  return {"/", {{"*", {root, w}}, root}};
      case 1:  return {"*", {{"/", {u, u}}, w}};
      case 2:  return {"/", {{"^", {u, number("2")}}, u}};
      case 3:  return {"/", {{"sin", {u}}, u}};
      default: return {"exp", {{"log", {u}}}};
    }
  }
  Expression near_double() {
    const Expression g = random_.one_in(2) ? linear() : polynomial(3);
    const Expression little = number(any({"0", "1e-12", "1e-9", "1e-6", "1e-4", "1e-30"}));
    switch (random_.below(3)) {
      case 0:  return {any({"-", "+"}), {{"^", {g, number("2")}}, little}};
      case 1:  return {"*", {g, {"-", {g, little}}}};
      default: return {"-", {{"abs", {g}}, little}};
    }
  }
  Expression pole() {
    const Expression a{"/", {constant(), linear()}};
    switch (random_.below(4)) {
      case 0:  return {"*", {a, {"/", {linear(), linear()}}}};
      case 1:  return {"/", {linear(), {"^", {linear(), number(any({"2", "3"}))}}}};
      case 2:  return {"+", {a, {"/", {number("1"), linear()}}}};
      default: return {"^", {linear(), minus(number(any({"1", "2", "3"})))}};
    }
  }
  Expression far_wave() {
    const Expression far{"*", {number(any({"5e6", "1e5", "1e8", "3000", "1e12", "100"})), argument()}};
    const Expression wave{
        any({"sin", "cos", "tan", "sin", "cos"}),
        {random_.one_in(2) ? far : Expression{"+", {linear(), number(any({"5e6", "1e9"}))}}}};
    return random_.one_in(2) ? wave : Expression{"+", {linear(), {"*", {constant(), wave}}}};
  }
  Expression flat() {
    const Expression big = number(any({"1e20", "1e30", "1e12", "1e40", "1e300"}));
    const Expression g{"/", {random_.one_in(2) ? linear() : polynomial(3), big}};
    switch (random_.below(5)) {
      case 0:  return {"log", {{"+", {number("1"), g}}}};
      case 1:  return {"-", {{"exp", {g}}, number("1")}};
      case 2:  return {any({"sin", "atan", "tanh", "asinh"}), {g}};
      case 3:  return {"*", {big, polynomial(3)}};
      default: return g;
    }
  }
  Expression jump() {
    switch (random_.below(5)) {
      case 0:  return {"+", {{"sign", {argument()}}, random_.one_in(2) ? number("0") : linear()}};
      case 1:  return {"-", {{any({"floor", "ceil"}), {argument()}}, number("0.5")}};
      case 2:  return {"mod", {argument(), number(any({"1", "2", "0.3"}))}};
      case 3:  return {"atan2", {argument(), argument()}};
      default: return choice(1);
    }
  }
  Expression power() {
    const Expression u = argument();
    switch (random_.below(8)) {
      case 0:  return {"^", {u, {"/", {number("0.3"), number("0.1")}}}};
      case 1:  return {"^", {u, {"*", {number("0.1"), number("20")}}}};
      case 2:  return {"^", {u, {"mod", {number("5"), number("3")}}}};
      case 3:  return {"^", {u, {"/", {number(any({"1", "2", "5", "4"})), number(any({"3", "2", "7"}))}}}};
      case 4:  return {"^", {u, argument()}};
      case 5:  return {"pow", {u, number(any({"0.5", "2.5", "7", "50", "0", "1"}))}};
      case 6:  return {"^", {u, minus(number(any({"1", "2", "0.5", "1.5"})))}};
      default: return {"^", {u, {"sqrt", {number(any({"2", "5"}))}}}};
    }
  }
  Expression series() {
    const Expression i = number("i");
    const Expression body = random_.one_in(2)
                                ? Expression{"/", {{any({"sin", "cos"}), {{"*", {i, linear()}}}}, i}}
                                : Expression{"/", {{"^", {linear(), i}}, i}};
    return {random_.one_in(4) ? "product" : "sum", {i, number("1"), number(any({"2", "3", "4"})), body}};
  }

  Random random_;
  std::vector<std::string> variables_;
  std::array<double, 3> aim_{};
};

// Rays through or far from a place, and boxes around it.
class RandomQuestions {
 public:
  RandomQuestions(std::uint64_t seed, const std::array<double, 3>& aim) : random_(seed), aim_(aim) {}

  Ray ray() {
    Ray ray{aim_, {}, 0, 0};
    for (double& d : ray.d)
      d = random_.one_in(5) ? 0 : random_.one_in(3) ? sign() : nice(random_.between(-2, 2));
    if (ray.d == std::array<double, 3>{}) ray.d[random_.below(3)] = sign();
    const double scale = random_.one_in(8) ? any({1e-6, 1e3, 1e6, 1e-3, 1e9}) : 1;
    if (random_.one_in(6))
      for (double& d : ray.d) d *= any({1e-6, 1e6, 1e3, 1e-3});
    if (!random_.one_in(3))
      for (double& o : ray.o) o += random_.one_in(3) ? 0 : nice(random_.between(-1, 1)) * scale;
    const double before = random_.between(0, 4) * scale, behind = random_.between(0, 4) * scale;
    ray.tmin = random_.one_in(3) ? -before : -nice(before),
    ray.tmax = random_.one_in(3) ? behind : nice(behind);
    switch (random_.below(8)) {
      case 0: ray.tmin = 0; break;
      case 1: ray.tmax = 0; break;
      case 2:  // from the near end on
        for (std::size_t i = 0; i < 3; ++i) ray.o[i] += ray.tmin * ray.d[i];
        ray.tmax -= ray.tmin, ray.tmin = 0;
        break;
      default: break;
    }
    if (random_.one_in(50)) ray.tmax = ray.tmin;
    return ray;
  }
  RealBox box() {
    RealBox box{};
    for (std::size_t i = 0; i < 3; ++i) {
      const double middle = random_.one_in(4) ? aim_[i] + random_.between(-2, 2) : aim_[i];
      double width = random_.one_in(4) ? 0 : std::exp2(-random_.between(-3, 24));
      if (random_.one_in(10)) width = any({1e6, 1e20, 1e300, 1e-30, 1e-300});
      double lo = middle - width * random_.between(0, 1), hi = middle + width * random_.between(0, 1);
      if (random_.one_in(6)) (random_.one_in(2) ? lo : hi) = 0;
      if (random_.one_in(10)) (random_.one_in(2) ? lo : hi) = any({1, -1, 2, 0.5, -5e-324, 5e-324});
      if (random_.one_in(16)) lo = -INFINITY;
      if (random_.one_in(16)) hi = INFINITY;
      box[2 * i] = std::min(lo, hi), box[2 * i + 1] = std::max(lo, hi);
    }
    return box;
  }
  // A point of a box: an end as often as not.
  std::array<double, 3> inside(const RealBox& box) {
    std::array<double, 3> point{};
    for (std::size_t i = 0; i < 3; ++i) {
      const double lo = std::max(box[2 * i], -1e300), hi = std::min(box[2 * i + 1], 1e300);
      const std::array choices{lo, hi, lo + (hi - lo) * random_.unit(), aim_[i], 0.0, lo / 2 + hi / 2};
      double x = choices[random_.below(choices.size())];
      if (std::isinf(box[2 * i]) || std::isinf(box[2 * i + 1]))
        x = random_.one_in(2) ? x : aim_[i] + random_.between(-1, 1) * any({1, 1e3, 1e30});
      point[i] = std::clamp(x, lo, hi);
    }
    return point;
  }

 private:
  static double nice(double x) { return std::round(x * 100) / 100; }
  double sign() { return random_.one_in(2) ? 1 : -1; }
  double any(std::initializer_list<double> values) { return values.begin()[random_.below(values.size())]; }

  Random random_;
  std::array<double, 3> aim_;
};

}  // namespace imp::test
