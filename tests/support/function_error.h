// The error of an elementary function as kernels compute it: compiled, over many arguments, against the
// exact value. f32: against the math library in double, whose own error is 2^-28 ulps of a float; f64:
// against MPFR.
#pragma once

#include <mpfr.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "ir/meaning.h"
#include "passes/elementary/bounds.h"
#include "runtime/kernel.h"
#include "tests/support/make.h"

namespace imp::test {

// An exact value as nearly as a long double tells it.
inline long double exact(Op op, double x, double y) {
  static constexpr mpfr_prec_t precision = 140;
  using Unary = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);
  const auto unary = [&]() -> Unary {
    switch (op) {
      case Op::exp:   return mpfr_exp;
      case Op::log:   return mpfr_log;
      case Op::cbrt:  return mpfr_cbrt;
      case Op::sin:   return mpfr_sin;
      case Op::cos:   return mpfr_cos;
      case Op::tan:   return mpfr_tan;
      case Op::asin:  return mpfr_asin;
      case Op::acos:  return mpfr_acos;
      case Op::atan:  return mpfr_atan;
      case Op::sinh:  return mpfr_sinh;
      case Op::cosh:  return mpfr_cosh;
      case Op::tanh:  return mpfr_tanh;
      case Op::asinh: return mpfr_asinh;
      case Op::acosh: return mpfr_acosh;
      case Op::atanh: return mpfr_atanh;
      default:        return nullptr;
    }
  }();
  mpfr_t a, b, r;
  mpfr_inits2(precision, a, b, r, nullptr);
  mpfr_set_d(a, op == Op::pow && x == 0 ? 0 : x, MPFR_RNDN);  // there -0 is 0
  mpfr_set_d(b, y, MPFR_RNDN);
  if (unary)
    unary(r, a, MPFR_RNDN);
  else if (op == Op::pow)
    mpfr_pow(r, a, b, MPFR_RNDN);
  else
    mpfr_atan2(r, a, b, MPFR_RNDN);
  const long double result = op == Op::pow && !(x >= 0 && y == y) ? std::nanl("") : mpfr_get_ld(r, MPFR_RNDN);
  mpfr_clears(a, b, r, nullptr);
  return result;
}

struct FunctionError {
  double ulps = 0, x = 0, y = 0;  // the largest error, and where
  std::uint64_t tried = 0;
  std::uint64_t wrong_kind = 0;  // NaN, an infinity or the sign of a zero where another is right
  std::uint64_t outside = 0;     // values outside of their bounds
  double wrong_x = 0, wrong_y = 0;

  void add(const FunctionError& other) {
    if (other.ulps > ulps) ulps = other.ulps, x = other.x, y = other.y;
    if (wrong_kind + outside == 0) wrong_x = other.wrong_x, wrong_y = other.wrong_y;
    tried += other.tried;
    wrong_kind += other.wrong_kind;
    outside += other.outside;
  }
};

// One function in one precision and one rounding mode, as a kernel.
class FunctionKernel {
 public:
  FunctionKernel(Op op, Type type, bool upward) : op_(op), type_(type) {
    Program program{.name = std::string(info(op).name)};
    std::vector<Expr> args;
    for (std::uint8_t i = 0; i < info(op).arity; ++i) args.push_back(input(program, i == 0 ? "x" : "y", f64));
    std::vector<Expr> numbers = args;
    if (type == f32)
      for (Expr& number : numbers) number = narrow(number);
    const Expr value = numbers.size() == 1 ? make(op, numbers[0]) : make(op, numbers[0], numbers[1]);
    const auto wide = [&](Expr v) { return type == f32 ? widen(v) : v; };
    output(program, "value", wide(value));
    if (upward) {  // what rounds upward makes the whole kernel do
      output(program, "above", wide(elementary::above(op, value)));
      output(program, "minus_below", wide(elementary::minus_below(op, value)));
    }
    auto kernel = make_kernel(std::move(program), {});
    IMP_ASSERT(kernel.has_value(), "a kernel of an elementary function");
    kernel_ = *std::move(kernel);
  }

  FunctionError measure(const std::vector<double>& x, const std::vector<double>& y) const {
    std::vector<Column> in{x};
    if (info(op_).arity == 2) in.push_back(y);
    const auto out = run_rows(*kernel_, in, x.size());
    FunctionError result;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double second = info(op_).arity == 2 ? y[i] : 0;
      ++result.tried;
      judge(result, x[i], second, out, i);
    }
    return result;
  }

 private:
  bool beyond(double x) const {
    return (op_ == Op::sin || op_ == Op::cos || op_ == Op::tan) &&
           std::abs(x) > elementary::largest_angle(type_);
  }

  // Everything that overflows counts as the first number beyond the range.
  double ulps_off(double value, long double right) const {
    const int lowest = type_ == f32 ? -126 : -1022, digits = type_ == f32 ? 23 : 52;
    const long double end = std::ldexp(1.0L, type_ == f32 ? 128 : 1024);
    const long double v = std::clamp<long double>(value, -end, end), r = std::clamp(right, -end, end);
    const int exponent = r == 0 ? lowest : std::max(std::ilogb(r), lowest);
    return static_cast<double>(std::abs(v - r) / std::ldexp(1.0L, exponent - digits));
  }

  void judge(FunctionError& result, double x, double y, const std::vector<Column>& out, std::size_t i) const {
    const double value = out[0][i];
    const long double right =
        type_ == f32 ? static_cast<long double>(meaning::real<double>(op_, x, y, 0)) : exact(op_, x, y);
    const auto wrong = [&](std::uint64_t& count) {
      if (result.wrong_kind + result.outside == 0) result.wrong_x = x, result.wrong_y = y;
      ++count;
    };
    if (std::isnan(right) || beyond(x)) {
      if (!std::isnan(value)) wrong(result.wrong_kind);
      return;
    }
    if (std::isnan(value) || (std::isinf(value) && std::isinf(right) && (value < 0) != (right < 0)) ||
        (right == 0 && (value != 0 || std::signbit(value) != std::signbit(right)))) {
      wrong(result.wrong_kind);
      return;
    }
    const double error = ulps_off(value, right);
    if (error > result.ulps) result.ulps = error, result.x = x, result.y = y;
    if (out.size() == 1) return;
    const long double uncertain = std::ldexp(std::abs(right), type_ == f32 ? -50 : -62);
    const long double slack = std::isinf(right) ? 0 : uncertain;
    if (!(out[1][i] >= right - slack) || !(out[2][i] >= -right - slack)) wrong(result.outside);
  }

  Op op_;
  Type type_;
  std::unique_ptr<Kernel> kernel_;
};

}  // namespace imp::test
