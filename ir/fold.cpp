// Exact folds: what is the same bits in either rounding mode, NaN and signed zeros included, and the same
// real number: 1/0 stays, as it is the empty set to an enclosure.
#include <cfenv>
#include <cmath>

#include "ir/graph.h"
#include "ir/meaning.h"
#include "ir/rounding.h"

namespace imp {
namespace {

struct Evaluated {
  double value;
  bool exact;
};

// Out of line and through volatile, so that no arithmetic moves across a change of the mode.
template <class T>
[[gnu::noinline]] Evaluated evaluate(Op op, std::array<double, 3> args, int mode) {
  const RoundingMode rounding(mode);
  std::feclearexcept(FE_ALL_EXCEPT);
  volatile T a = static_cast<T>(args[0]);
  volatile T b = static_cast<T>(args[1]);
  volatile T c = static_cast<T>(args[2]);
  volatile T value = meaning::real<T>(op, a, b, c);
  return {value, std::fetestexcept(FE_ALL_EXCEPT) == 0};
}

[[gnu::noinline]] Evaluated narrow(double wide, int mode) {
  const RoundingMode rounding(mode);
  volatile double source = wide;
  volatile float value = static_cast<float>(source);
  return {value, value == wide || std::isnan(wide)};
}

// Always exact, whatever the flags of the library's implementation say.
bool only_selects_bits(Op op) {
  return op == Op::neg || op == Op::abs || op == Op::min || op == Op::max || op == Op::floor ||
         op == Op::ceil || op == Op::sign || op == Op::exponent;
}

}  // namespace

std::optional<Id> Graph::fold_constants(Op op, Type type, std::span<const Id> args) {
  std::array<double, 3> values{};
  bool numbers = !args.empty();
  for (std::size_t i = 0; i < args.size() && numbers; ++i) {
    const auto value = number(args[i]);
    numbers = value.has_value();
    values[i] = value.value_or(0);
  }
  if (!numbers) return std::nullopt;

  const OpKind kind = info(op).kind;
  if (kind == OpKind::compare) return constant(meaning::truth<double>(op, values[0], values[1]));
  if (op == Op::widen) return constant(f64, values[0]);
  if (kind == OpKind::convert) {
    const Evaluated result = narrow(values[0], op == Op::narrow_up ? FE_UPWARD : FE_TONEAREST);
    return op == Op::narrow_up || result.exact ? std::optional(constant(f32, result.value)) : std::nullopt;
  }
  if (kind != OpKind::real && kind != OpKind::upward) return std::nullopt;
  const int mode = kind == OpKind::upward ? FE_UPWARD : FE_TONEAREST;
  const Evaluated result =
      type == f32 ? evaluate<float>(op, values, mode) : evaluate<double>(op, values, mode);
  return kind == OpKind::upward || result.exact || only_selects_bits(op)
             ? std::optional(constant(type, result.value))
             : std::nullopt;
}

std::optional<Id> Graph::fold(Op op, Type type, std::span<const Id> args) {
  if (auto value = fold_constants(op, type, args)) return value;

  const auto op_of = [&](std::size_t i) { return nodes_[args[i].index].op; };
  const auto inner = [&](std::size_t i, std::size_t k = 0) { return (*this)[args[i]].args[k]; };
  const auto is = [&](std::size_t i, double value) { return is_number(args[i], value); };
  const auto is_truth = [&](std::size_t i, bool value) { return truth_value(args[i]) == value; };
  const bool same_operands = args.size() == 2 && args[0] == args[1];

  switch (op) {
    case Op::neg:
      if (op_of(0) == Op::neg) return inner(0);
      break;
    case Op::abs:
      if (op_of(0) == Op::abs) return args[0];
      if (op_of(0) == Op::neg) return add(Op::abs, {inner(0)});
      break;
    case Op::min:
    case Op::max:
      if (same_operands) return args[0];
      break;
    case Op::mul:
    case Op::mul_up:
      if (is(0, 1)) return args[1];
      if (is(1, 1)) return args[0];
      break;
    case Op::div:
    case Op::div_up:
      if (is(1, 1)) return args[0];
      break;
    case Op::sub:
      if (is(1, 0.0)) return args[0];
      break;
    case Op::add:
      if (is(0, -0.0)) return args[1];
      if (is(1, -0.0)) return args[0];
      break;
    case Op::add_up:  // here a zero of either sign is never below the exact value
      if (is(0, 0.0) || is(0, -0.0)) return args[1];
      if (is(1, 0.0) || is(1, -0.0)) return args[0];
      break;
    case Op::lt:
      if (same_operands) return constant(false);
      break;
    case Op::and_:
      if (same_operands || is_truth(0, true)) return args[1];
      if (is_truth(1, true)) return args[0];
      if (is_truth(0, false) || is_truth(1, false)) return constant(false);
      break;
    case Op::or_:
      if (same_operands || is_truth(0, false)) return args[1];
      if (is_truth(1, false)) return args[0];
      if (is_truth(0, true) || is_truth(1, true)) return constant(true);
      break;
    case Op::not_:
      if (const auto value = truth_value(args[0])) return constant(!*value);
      if (op_of(0) == Op::not_) return inner(0);
      break;
    case Op::select:
      if (args[1] == args[2]) return args[1];
      if (is_truth(0, true)) return args[1];
      if (is_truth(0, false)) return args[2];
      if (op_of(0) == Op::not_) return add(Op::select, {inner(0), args[2], args[1]});
      break;
    case Op::any:
    case Op::all:
      if (nodes_[args[0].index].op == Op::constant) return args[0];
      break;
    case Op::load:
      if (op_of(0) == Op::fill) return inner(0);
      break;
    default: break;
  }
  return std::nullopt;
}

}  // namespace imp
