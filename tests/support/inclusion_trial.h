// Inclusion functions of single ops on random boxes: every value lies within, and how wide they are
// beside the range.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "ir/meaning.h"
#include "passes/elementary/bounds.h"
#include "passes/extend/inclusion.h"
#include "runtime/kernel.h"
#include "tests/support/ball.h"
#include "tests/support/boxes.h"
#include "tests/support/make.h"

namespace imp::test {

// An op as a formula of x and y.
struct OpForm {
  std::string name;
  std::function<Expr(Expr, Expr)> build;
  Box1 usual{-20, 20};          // where most boxes are to lie
  std::vector<double> turns{};  // where it has an extreme or a jump; with its period, if it has one
  double period = 0;
  bool known = true;   // the range is that of the corners and the turns
  bool steps = false;  // continuous where it takes one value only
};

inline std::vector<OpForm> op_forms() {
  constexpr double pi = std::numbers::pi;
  const auto one = [](Op op) { return [op](Expr x, Expr) { return make(op, x); }; };
  const auto two = [](Op op) { return [op](Expr x, Expr y) { return make(op, x, y); }; };
  const auto power = [](double n) {
    return [n](Expr x, Expr) { return make(Op::powi, x, constant_like(x, n)); };
  };
  return {
      {"add", two(Op::add)},
      {"sub", two(Op::sub)},
      {"mul", two(Op::mul), {-20, 20}, {0}},
      {"square", [](Expr x, Expr) { return x * x; }, {-20, 20}, {0}},
      {"div", two(Op::div), {-20, 20}, {0}},
      {"div-by-1e40", [](Expr x, Expr) { return x / 1e40; }, {-3e38, 3e38}},
      {"mul-by-1e40", [](Expr x, Expr) { return x * 1e40; }},
      {"recip", [](Expr x, Expr) { return 1.0 / x; }},
      {"fma", [](Expr x, Expr y) { return fma(x, y, constant_like(x, 3)); }},
      {"neg", one(Op::neg)},
      {"abs", one(Op::abs), {-20, 20}, {0}},
      {"min", two(Op::min)},
      {"max", two(Op::max)},
      {"sqrt", one(Op::sqrt), {-1, 20}, {0}},
      {"floor", one(Op::floor), {-20, 20}, {}, 0, true, true},
      {"ceil", one(Op::ceil), {-20, 20}, {}, 0, true, true},
      {"sign", one(Op::sign), {-20, 20}, {0}, 0, true, true},
      {"mod", two(Op::mod), {-20, 20}, {0}, 0, false},
      {"x^2", power(2), {-20, 20}, {0}},
      {"x^3", power(3)},
      {"x^8", power(8), {-3, 3}, {0}},
      {"x^17", power(17), {-2, 2}},
      {"x^-1", power(-1)},
      {"x^-2", power(-2)},
      {"select", [](Expr x, Expr y) { return select(x < y, x, y * y); }, {-20, 20}, {0}, 0, false},
      {"pow", two(Op::pow), {-0.5, 4}, {0, 1}},
      {"cbrt", one(Op::cbrt)},
      {"exp", one(Op::exp), {-100, 100}},
      {"log", one(Op::log), {-0.5, 3}},
      {"sin", one(Op::sin), {-20, 20}, {pi / 2, -pi / 2}, 2 * pi},
      {"cos", one(Op::cos), {-20, 20}, {0, pi}, 2 * pi},
      {"tan", one(Op::tan), {-5, 5}},
      {"asin", one(Op::asin), {-1.2, 1.2}, {-1, 1}},
      {"acos", one(Op::acos), {-1.2, 1.2}, {-1, 1}},
      {"atan", one(Op::atan)},
      {"atan2", two(Op::atan2), {-2, 2}, {0}},
      {"sinh", one(Op::sinh), {-95, 95}},
      {"cosh", one(Op::cosh), {-95, 95}, {0}},
      {"tanh", one(Op::tanh), {-8, 8}},
      {"asinh", one(Op::asinh)},
      {"acosh", one(Op::acosh), {0.5, 5}, {1}},
      {"atanh", one(Op::atanh), {-1.2, 1.2}},
  };
}

// Ratios from 1 to 2^64, counted by their logarithm: a hundredth of an octave is told apart.
class Ratios {
 public:
  void add(double ratio) {
    const double place = std::clamp(100 * std::log2(ratio), 0.0, 6399.0);
    ++counts_[static_cast<std::size_t>(place)];
    ++total_;
    most_ = std::max(most_, ratio);
  }
  void add(const Ratios& other) {
    for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] += other.counts_[i];
    total_ += other.total_;
    most_ = std::max(most_, other.most_);
  }
  std::uint64_t total() const { return total_; }
  double most() const { return most_; }
  double median() const {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < counts_.size(); ++i)
      if (2 * (sum += counts_[i]) >= total_) return std::exp2(static_cast<double>(i) / 100);
    return 1;
  }

 private:
  std::vector<std::uint64_t> counts_ = std::vector<std::uint64_t>(6400);
  std::uint64_t total_ = 0;
  double most_ = 0;
};

struct InclusionCount {
  std::uint64_t boxes = 0, values = 0;
  std::uint64_t misses = 0;       // values outside
  std::uint64_t overclaimed = 0;  // "defined and continuous" where there is no value
  Ratios width;                   // of the enclosure, by that of the range
  std::string first;              // of what is wrong

  void add(const InclusionCount& other) {
    if (first.empty()) first = other.first;
    boxes += other.boxes, values += other.values;
    misses += other.misses, overclaimed += other.overclaimed;
    width.add(other.width);
  }
};

// One op in one type and some forms, each as a kernel.
class InclusionTrial {
 public:
  InclusionTrial(const OpForm& op, std::span<const Inclusion> forms, Type type,
                 const KernelOptions& options = {})
      : op_(op), type_(type), f_{.name = "f"} {
    const Expr x = input(f_, "x", f64), y = input(f_, "y", f64);
    output(f_, "f", op.build(x, y));
    for (const Inclusion& form : forms) {
      Diagnostics diagnostics;
      auto extended = extension(f_, *form.enclose, type, diagnostics);
      if (!extended) continue;
      auto kernel = make_kernel(*std::move(extended), options);
      if (!kernel) throw std::runtime_error(kernel.error().message);
      kernels_.emplace_back(form.name, *std::move(kernel));
    }
    for (std::uint32_t i = 0; i < f_.graph.size(); ++i)
      for (const Id arg : f_.graph[Id{i}].args) binary_ |= arg == f_.inputs[1].id;
  }

  // How many of the forms have a rule for the op.
  std::size_t forms() const { return kernels_.size(); }
  std::string_view form(std::size_t i) const { return kernels_[i].first; }

  // `size` boxes, of which `seed` tells which: a count for every form that has a rule.
  std::vector<InclusionCount> run(std::uint64_t seed, std::size_t size) const {
    Boxes boxes(seed);
    std::array<std::vector<double>, 4> ends;
    for (std::size_t i = 0; i < size; ++i) {
      const Box1 x = box(boxes), y = boxes.pick(8) == 0 ? x : box(boxes);
      ends[0].push_back(x.lo), ends[1].push_back(x.hi);
      ends[2].push_back(y.lo), ends[3].push_back(y.hi);
    }
    std::vector<Enclosures> found;
    for (const auto& [name, kernel] : kernels_) {
      Enclosures& e = found.emplace_back(size);
      const std::array<const void*, 4> in{ends[0].data(), ends[1].data(), ends[2].data(), ends[3].data()};
      const std::array<void*, 3> out{e.lo.data(), e.hi.data(), e.defined.data()};
      kernel->run({size, in, out});
    }

    std::vector<InclusionCount> counts(found.size());
    for (InclusionCount& count : counts) count.boxes = size;
    for (std::size_t i = 0; i < size; ++i) {
      const Box1 x{ends[0][i], ends[1][i]}, y{ends[2][i], ends[3][i]};
      const auto values = some_values(boxes, x, y);
      for (std::size_t k = 0; k < found.size(); ++k)
        judge(counts[k], values, x, y, {found[k].lo[i], found[k].hi[i]}, found[k].defined[i] != 0);
    }
    return counts;
  }

 private:
  struct Enclosures {
    explicit Enclosures(std::size_t size) : lo(size), hi(size), defined(size) {}
    std::vector<double> lo, hi;
    std::vector<unsigned char> defined;
  };

  // A value, by long double where that is as good as exact.
  struct Value {
    double x, y;
    std::optional<long double> quick;
    std::optional<Ball> exact{};  // made when it is needed
  };

  // In float most ends are floats, so that it is the form that is judged, not the narrowing.
  Box1 box(Boxes& boxes) const {
    Box1 box = boxes.pick(3) == 0 ? boxes.box() : boxes.within(op_.usual.lo, op_.usual.hi);
    if (type_ == f32 && boxes.pick(4) != 0)
      box = {static_cast<double>(static_cast<float>(box.lo)),
             static_cast<double>(static_cast<float>(box.hi))};
    const double most = std::numeric_limits<double>::max();
    return {std::min(box.lo, most), std::max(box.hi, -most)};
  }

  std::vector<Value> some_values(Boxes& boxes, Box1 x, Box1 y) const {
    std::vector<Value> values;
    const auto ys = binary_ ? places(boxes, y) : std::vector{0.0};
    for (const double px : places(boxes, x))
      for (const double py : ys) values.push_back({px, py, quick_value(px, py)});
    for (Value& value : values)
      if (!value.quick) value.exact = exact_value(value);
    return values;
  }

  Ball exact_value(const Value& value) const { return ball_values(f_, std::array{value.x, value.y})[0]; }

  void judge(InclusionCount& count, const std::vector<Value>& values, Box1 x, Box1 y, Box1 found,
             bool defined) const {
    Box1 range{INFINITY, -INFINITY};
    bool everywhere = true;
    for (const Value& value : values) {
      check(count, value, x, y, found, defined);
      const double number = value.quick ? static_cast<double>(*value.quick) : value.exact->nearest();
      everywhere &= std::isfinite(number);
      range = {std::min(range.lo, number), std::max(range.hi, number)};
    }
    if (op_.steps && defined && range.lo < range.hi) ++count.overclaimed;
    measure(count, x, y, range, found, op_.known && defined && everywhere);
  }

  // The ends, what turns between them, and one place more.
  std::vector<double> places(Boxes& boxes, Box1 box) const {
    std::vector<double> result;
    for (const double end : {box.lo, box.hi})
      if (std::isfinite(end)) result.push_back(end);
    for (const double turn : op_.turns) {
      double place = turn;
      if (op_.period > 0 && std::isfinite(box.lo))
        place += op_.period * std::ceil((box.lo - turn) / op_.period);
      if (box.lo < place && place < box.hi) result.push_back(place);
    }
    const double inner = boxes.inside(box);
    if (box.lo <= inner && inner <= box.hi) result.push_back(inner);
    return result;
  }

  // Whether the value lies within. Where long double does not tell for sure, Arb does.
  void check(InclusionCount& count, const Value& value, Box1 x, Box1 y, Box1 found, bool defined) const {
    ++count.values;
    if (value.quick) {
      const long double slack = exact_op() ? 0 : std::abs(*value.quick) * 0x1p-56L + 0x1p-1073L;
      if (found.lo <= *value.quick - slack && *value.quick + slack <= found.hi) return;
    }
    const Ball exact = value.exact ? *value.exact : exact_value(value);
    const auto complain = [&](std::uint64_t& number, const char* what) {
      ++number;
      if (count.first.empty())
        count.first =
            fmt::format("{} of [{:a}, {:a}], [{:a}, {:a}] at {:a}, {:a} is {:a}, {} [{:a}, {:a}]", op_.name,
                        x.lo, x.hi, y.lo, y.hi, value.x, value.y, exact.nearest(), what, found.lo, found.hi);
    };
    if (exact.certainly_outside(found.lo, found.hi)) complain(count.misses, "not in");
    if (exact.is(Ball::State::none) && defined) complain(count.overclaimed, "yet defined in");
  }

  bool exact_op() const {
    switch (f_.graph[f_.outputs[0].id].op) {
      case Op::neg:
      case Op::abs:
      case Op::min:
      case Op::max:
      case Op::floor:
      case Op::ceil:
      case Op::sign:  return true;
      default:        return false;
    }
  }

  // By the math library in long double, of one op with a few roundings at most.
  std::optional<long double> quick_value(double px, double py) const {
    const Node node = f_.graph[f_.outputs[0].id];
    const OpKind kind = info(node.op).kind;
    if ((kind != OpKind::real && kind != OpKind::elementary) || node.op == Op::mod || takes_integers(node.op))
      return std::nullopt;
    std::array<long double, 3> args{};
    for (std::size_t i = 0; i < node.args.size(); ++i) {
      const Node arg = f_.graph[node.args[i]];
      if (arg.op == Op::input)
        args[i] = (arg.payload == 0 ? px : py) + 0.0;
      else if (arg.op == Op::constant)
        args[i] = f_.graph.number(node.args[i]).value_or(NAN);
      else
        return std::nullopt;
    }
    const long double value = meaning::real<long double>(node.op, args[0], args[1], args[2]);
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
  }

  // Only where the range is known, and is wide enough that a rounding more or less is of no matter.
  void measure(InclusionCount& count, Box1 x, Box1 y, Box1 range, Box1 found, bool known) const {
    const double width = range.hi - range.lo, size = std::max(std::abs(range.lo), std::abs(range.hi));
    const double most = type_ == f32 ? 1e30 : 1e300;
    if (!known || !(width >= 0x1p-10 * size) || !(size > 1 / most) || !(size < most)) return;
    for (const double end : {x.lo, x.hi, y.lo, y.hi})
      if (!(std::abs(end) < most)) return;
    count.width.add((found.hi - found.lo) / width);
  }

  OpForm op_;
  Type type_;
  Program f_;
  bool binary_ = false;
  std::vector<std::pair<std::string_view, std::unique_ptr<Kernel>>> kernels_;
};

}  // namespace imp::test
