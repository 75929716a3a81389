// The error of an elementary function as kernels compute it: compiled, over many arguments, against the
// exact value. f32: against the math library in double, whose own error is 2^-28 ulps of a float; f64:
// against MPFR.
#pragma once

#include <mpfr.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
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

// One function in one precision, whose type is `Number`, and one rounding mode, as a kernel.
template <class Number>
class KernelOf {
  static constexpr bool single = std::is_same_v<Number, float>;
  // Reference values: in double the math library is exact enough for floats, and quick.
  using Exact = std::conditional_t<single, double, long double>;

 public:
  KernelOf(Op op, bool upward, Backend backend)
      : op_(op), binary_(info(op).arity == 2), knows_nan_(backend != Backend::glsl) {
    const Type type = single ? f32 : f64;
    Program program{.name = std::string(info(op).name)};
    std::vector<Expr> args{input(program, "x", type)};
    if (binary_) args.push_back(input(program, "y", type));
    const Expr value = binary_ ? make(op, args[0], args[1]) : make(op, args[0]);
    output(program, "value", value);
    if (upward) {  // what rounds upward makes the whole kernel do
      output(program, "above", elementary::above(op, value));
      output(program, "minus_below", elementary::minus_below(op, value));
    }
    auto kernel = make_kernel(std::move(program), {.backend = backend});
    IMP_ASSERT(kernel.has_value(), "a kernel of an elementary function");
    kernel_ = *std::move(kernel);
  }

  FunctionError measure(const std::vector<double>& wide_x, const std::vector<double>& wide_y) const {
    const std::vector<Number> x(wide_x.begin(), wide_x.end()), y(wide_y.begin(), wide_y.end());
    std::vector<std::vector<Number>> results(kernel_->program().outputs.size(), x);
    std::vector<const void*> in{x.data()};
    if (binary_) in.push_back(y.data());
    std::vector<void*> out;
    for (auto& result : results) out.push_back(result.data());
    kernel_->run({x.size(), in, out});

    FunctionError error;
    error.tried = x.size();
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Number second = binary_ ? y[i] : 0;
      const Exact right = exact_value(x[i], second);
      switch (judge(error, x[i], second, results[0][i], right)) {
        case Verdict::bounds_count:
          if (results.size() > 1 && !within(right, results[1][i], results[2][i]))
            complain(error, error.outside, x[i], second);
          break;
        case Verdict::wrong:    complain(error, error.wrong_kind, x[i], second); break;
        case Verdict::no_value: break;
      }
    }
    return error;
  }

 private:
  enum class Verdict : std::int8_t { bounds_count, wrong, no_value };

  Exact exact_value(Number x, Number y) const {
    if (beyond(x)) return std::numeric_limits<Exact>::quiet_NaN();
    if constexpr (single)
      return meaning::real<double>(op_, x, y, 0);
    else
      return exact(op_, x, y);
  }

  bool beyond(Number x) const {
    const bool angle = op_ == Op::sin || op_ == Op::cos || op_ == Op::tan;
    return angle && std::abs(x) > elementary::largest_angle(single ? f32 : f64);
  }

  // Ulps between the two. What overflows counts as the first number beyond the range.
  static double ulps_off(Number value, Exact right) {
    constexpr int lowest = std::numeric_limits<Number>::min_exponent - 1;
    constexpr int digits = std::numeric_limits<Number>::digits - 1;
    static const Exact end = std::ldexp(Exact(1), lowest == -126 ? 128 : 1024);
    const Exact v = std::clamp<Exact>(value, -end, end), r = std::clamp(right, -end, end);
    if constexpr (single) {  // by the bits of a double: this is what takes the time
      const int exponent = static_cast<int>((std::bit_cast<std::uint64_t>(r) >> 52) & 0x7ff) - 1023;
      const auto scale = static_cast<std::uint64_t>(1023 + digits - std::max(exponent, lowest)) << 52;
      return std::abs(v - r) * std::bit_cast<double>(scale);
    } else {
      const int exponent = r == 0 ? lowest : std::max(std::ilogb(r), lowest);
      return static_cast<double>(std::ldexp(std::abs(v - r), digits - exponent));
    }
  }

  Verdict judge(FunctionError& error, Number x, Number y, Number value, Exact right) const {
    if (std::isnan(right)) return std::isnan(value) || !knows_nan_ ? Verdict::no_value : Verdict::wrong;
    if (std::isnan(value)) return Verdict::wrong;
    if (std::isinf(value) && std::isinf(right) && (value < 0) != (right < 0)) return Verdict::wrong;
    if (right == 0 && (value != 0 || std::signbit(value) != std::signbit(right))) return Verdict::wrong;
    const double off = ulps_off(value, right);
    if (off > error.ulps) error.ulps = off, error.x = x, error.y = y;
    return Verdict::bounds_count;
  }

  // But for the error of the reference value.
  static bool within(Exact right, Number above, Number minus_below) {
    const Exact slack = std::isinf(right) ? 0 : std::abs(right) * Exact(single ? 0x1p-50 : 0x1p-62);
    return above >= right - slack && minus_below >= -right - slack;
  }

  static void complain(FunctionError& error, std::uint64_t& count, Number x, Number y) {
    if (error.wrong_kind + error.outside == 0) error.wrong_x = x, error.wrong_y = y;
    ++count;
  }

  Op op_;
  bool binary_;
  bool knows_nan_;  // a driver may take NaN for a number (docs/decisions/glsl.md)
  std::unique_ptr<Kernel> kernel_;
};

class FunctionKernel {
 public:
  FunctionKernel(Op op, Type type, bool upward, Backend backend = Backend::llvm) {
    if (type == f32)
      single_.emplace(op, upward, backend);
    else
      double_.emplace(op, upward, backend);
  }

  // `y` is of no matter to functions of one argument.
  FunctionError measure(const std::vector<double>& x, const std::vector<double>& y) const {
    return single_ ? single_->measure(x, y) : double_->measure(x, y);
  }

 private:
  std::optional<KernelOf<float>> single_;
  std::optional<KernelOf<double>> double_;
};

}  // namespace imp::test
