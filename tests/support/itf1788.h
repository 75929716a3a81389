// Interval test vectors (tests/data/itf1788.txt) and their trial: what the interval extension answers,
// beside what is right, which is the tightest interval of doubles.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "passes/elementary/lower.h"
#include "passes/extend/forms.h"
#include "tests/support/boxes.h"
#include "tests/support/evaluate.h"
#include "tests/support/make.h"

namespace imp::test {

struct DecoratedBox {
  Box1 box;
  std::string decoration;  // com, dac, def or trv; or none

  bool empty() const { return box.lo > box.hi; }
  bool continuous() const { return decoration == "com" || decoration == "dac"; }
};

struct TestVector {
  std::string text, op;
  std::vector<DecoratedBox> operands, results;
  int exponent = 0;  // of pown, which is no interval
};

namespace detail {

inline DecoratedBox decorated_box(const std::string& word) {
  char* rest = nullptr;
  DecoratedBox result;
  result.box.lo = std::strtod(word.c_str(), &rest);
  if (*rest != ',') throw std::runtime_error("no interval: " + word);
  result.box.hi = std::strtod(rest + 1, &rest);
  if (*rest == ',') result.decoration = rest + 1;
  return result;
}

inline TestVector test_vector(const std::string& line) {
  TestVector result{.text = line, .op = {}, .operands = {}, .results = {}};
  std::istringstream words(line);
  words >> result.op;
  bool right = false;
  for (std::string word; words >> word;) {
    if (word == "=")
      right = true;
    else if (!word.contains(','))
      result.exponent = std::stoi(word);
    else
      (right ? result.results : result.operands).push_back(decorated_box(word));
  }
  if (result.operands.empty() || result.results.empty()) throw std::runtime_error("no vector: " + line);
  return result;
}

}  // namespace detail

// Throws std::runtime_error where the file is not as it should be.
inline std::vector<TestVector> load_test_vectors(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path.string() + ": can't be opened");
  std::vector<TestVector> result;
  for (std::string line; std::getline(file, line);) result.push_back(detail::test_vector(line));
  return result;
}

// The operations of the vectors in ours; nothing for one that we have not.
using Formula3 = std::function<Expr(Expr, Expr, Expr)>;
inline Formula3 formula_of(const std::string& op, int exponent) {
  if (op == "pown") return [=](Expr a, Expr, Expr) { return make(Op::powi, a, constant_like(a, exponent)); };
  const auto number = [](Expr like, double value) { return constant_like(like, value); };
  const auto log_of = [=](Expr a, double base) { return make(Op::log, a) / make(Op::log, number(a, base)); };
  static const std::map<std::string, Formula3> composed{
      {"recip", [](Expr a, Expr, Expr) { return 1.0 / a; }},
      {"sqr", [](Expr a, Expr, Expr) { return a * a; }},
      {"pos", [](Expr a, Expr, Expr) { return a; }},
      {"hypot", [](Expr a, Expr b, Expr) { return sqrt(a * a + b * b); }},
      {"exp2", [=](Expr a, Expr, Expr) { return make(Op::pow, number(a, 2), a); }},
      {"exp10", [=](Expr a, Expr, Expr) { return make(Op::pow, number(a, 10), a); }},
      {"expm1", [](Expr a, Expr, Expr) { return make(Op::exp, a) - 1.0; }},
      {"log2", [=](Expr a, Expr, Expr) { return log_of(a, 2); }},
      {"log10", [=](Expr a, Expr, Expr) { return log_of(a, 10); }},
      {"logp1", [](Expr a, Expr, Expr) { return make(Op::log, a + 1.0); }},
      {"cot", [](Expr a, Expr, Expr) { return 1.0 / make(Op::tan, a); }},
      {"sec", [](Expr a, Expr, Expr) { return 1.0 / make(Op::cos, a); }},
      {"csc", [](Expr a, Expr, Expr) { return 1.0 / make(Op::sin, a); }},
      {"coth", [](Expr a, Expr, Expr) { return 1.0 / make(Op::tanh, a); }},
      {"sech", [](Expr a, Expr, Expr) { return 1.0 / make(Op::cosh, a); }},
      {"csch", [](Expr a, Expr, Expr) { return 1.0 / make(Op::sinh, a); }},
  };
  if (const auto it = composed.find(op); it != composed.end()) return it->second;
  const auto known = op_named(op);
  if (!known || (info(*known).kind != OpKind::real && info(*known).kind != OpKind::elementary)) return {};
  return [op = *known](Expr a, Expr b, Expr c) {
    return info(op).arity == 1 ? make(op, a) : info(op).arity == 2 ? make(op, a, b) : make(op, a, b, c);
  };
}

// How far apart two ends are, in ulps of the one that is right; an ulp is no less than the smallest
// normal number. Infinite where one is.
inline double ulps_between(double found, double right, Type type) {
  if (found == right) return 0;
  const int digits = type == f32 ? 23 : 52, lowest = type == f32 ? -126 : -1022;
  const int exponent =
      right == 0 || std::isinf(right) ? lowest : std::max(std::ilogb(right) - digits, lowest);
  return std::ldexp(std::abs(found - right), -exponent);
}

// The vectors of one operation (of pown: of one exponent) on its extension in one type.
class Trial {
 public:
  struct Answer {
    Box1 box;
    bool defined = false;

    bool empty() const { return box.lo > box.hi; }
  };

  Trial(const std::string& op, int exponent, std::size_t arity, Type type) : type_(type) {
    Program f{.name = "f"};
    std::array<Expr, 3> args;
    for (std::size_t i = 0; i < 3; ++i) args[i] = input(f, std::string(1, "abc"[i]), f64);
    if (arity < 3) args[2] = args[arity - 1];
    output(f, "f", formula_of(op, exponent)(args[0], args[1], args[2]));
    Diagnostics diagnostics;
    auto extended = extension(f, interval_form, type, diagnostics);
    if (!extended) throw std::runtime_error(to_text(diagnostics));
    kernel_ = interpret(lower_elementary(*extended));
  }

  Answer answer(const TestVector& vector) const {
    std::array<double, 6> inputs{0, 0, 0, 0, 0, 0};
    for (std::size_t i = 0; i < vector.operands.size(); ++i) {
      inputs[2 * i] = vector.operands[i].box.lo;
      inputs[2 * i + 1] = vector.operands[i].box.hi;
    }
    const auto values = evaluate(*kernel_, inputs);
    return {{values[0], values[1]}, values[2] != 0};
  }

  // By how many ulps `answer` is wider than the tightest interval of this type, which is `right` outward.
  double excess(Box1 answer, Box1 right) const {
    const double lo = type_ == f64 ? right.lo : -float_above(-right.lo);
    const double hi = type_ == f64 ? right.hi : float_above(right.hi);
    return ulps_between(answer.lo, lo, type_) + ulps_between(answer.hi, hi, type_);
  }

  // Whether the type holds the operands: else they are narrowed outward, and the answer is of more.
  bool holds(const TestVector& vector) const {
    return std::ranges::all_of(vector.operands, [&](const DecoratedBox& d) {
      return type_ == f64 || (d.box.lo == static_cast<double>(static_cast<float>(d.box.lo)) &&
                              d.box.hi == static_cast<double>(static_cast<float>(d.box.hi)));
    });
  }

 private:
  static double float_above(double x) {
    const auto near = static_cast<float>(x);
    return static_cast<double>(near) >= x ? near
                                          : std::nextafterf(near, std::numeric_limits<float>::infinity());
  }

  Type type_;
  std::unique_ptr<Kernel> kernel_;
};

// What became of the vectors of an operation.
struct TrialCount {
  std::size_t tried = 0;
  std::size_t missed = 0;          // the answer does not hold what is right
  std::size_t overclaimed = 0;     // said to be continuous, and is not
  std::size_t not_empty = 0;       // where empty is right
  std::size_t flags = 0, shy = 0;  // decorated vectors; continuous, and not said to be
  std::size_t unbounded = 0;       // an infinite end where a finite one is right
  std::size_t wide = 0;            // more than 1000 ulps wider than right: not in `measured`
  std::size_t measured = 0, exact = 0;
  double sum = 0, most = 0;  // excess in ulps
  std::string first;         // vector of those missed or overclaimed

  void add(const TrialCount& other) {
    if (first.empty()) first = other.first;
    tried += other.tried, missed += other.missed, overclaimed += other.overclaimed;
    not_empty += other.not_empty, flags += other.flags, shy += other.shy, wide += other.wide;
    measured += other.measured, exact += other.exact, sum += other.sum, most = std::max(most, other.most);
  }
};

// Judges one vector. The flag is about the operation: where an operand's decoration says less than
// continuous, so does that of the result, whatever the operation.
inline TrialCount judge(const Trial& trial, const TestVector& vector) {
  const Trial::Answer answer = trial.answer(vector);
  const DecoratedBox& right = vector.results[0];
  TrialCount count;
  count.tried = 1;
  const bool within = answer.box.lo <= right.box.lo && right.box.hi <= answer.box.hi;
  if (!right.empty() && !within) count.missed = 1;
  const bool of_op = std::ranges::all_of(vector.operands, &DecoratedBox::continuous);
  if (of_op && !right.decoration.empty()) {
    count.flags = 1;
    if (answer.defined && !right.continuous()) count.overclaimed = 1;
    if (!answer.defined && right.continuous()) count.shy = 1;
  }
  if (answer.defined && right.empty()) count.overclaimed = 1;
  if (count.missed + count.overclaimed != 0) count.first = vector.text;

  if (right.empty()) {
    count.not_empty = answer.empty() ? 0 : 1;
  } else if (trial.holds(vector)) {
    const double excess = trial.excess(answer.box, right.box);
    if (excess > 1000) {
      count.wide = 1;
    } else {
      count.measured = 1, count.exact = excess == 0 ? 1 : 0, count.sum = count.most = excess;
    }
  }
  return count;
}

// All vectors, by operation.
inline std::map<std::string, TrialCount> try_vectors(const std::vector<TestVector>& vectors, Type type) {
  std::map<std::string, TrialCount> counts;
  std::map<std::pair<std::string, int>, Trial> trials;
  for (const TestVector& vector : vectors) {
    if (!formula_of(vector.op, vector.exponent)) continue;
    const auto key = std::pair(vector.op, vector.exponent);
    const auto [trial, fresh] =
        trials.try_emplace(key, vector.op, vector.exponent, vector.operands.size(), type);
    counts[vector.op].add(judge(trial->second, vector));
  }
  return counts;
}

}  // namespace imp::test
