// The value of a formula at a point by ball arithmetic (Arb, 128 bits): a second opinion, which shares
// nothing with the arithmetic that the compiler itself does on the host.
#pragma once

#include <arb.h>

#include <cmath>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "ir/program.h"
#include "ir/replay.h"

namespace imp::test {

// A real number to within a tiny radius; or known to have no value; or not known. Truths alike.
class Ball {
 public:
  enum class State : std::int8_t { number, none, unknown, yes, no };
  static constexpr slong precision = 128;

  explicit Ball(State state = State::unknown) : state_(state) { arb_init(x_); }
  explicit Ball(double value) : state_(State::number) {
    arb_init(x_);
    arb_set_d(x_, value);
  }
  Ball(const Ball& other) : state_(other.state_) {
    arb_init(x_);
    arb_set(x_, other.x_);
  }
  Ball(Ball&& other) noexcept : state_(other.state_) {
    arb_init(x_);
    arb_swap(x_, other.x_);
  }
  Ball& operator=(const Ball& other) {
    state_ = other.state_;
    arb_set(x_, other.x_);
    return *this;
  }
  Ball& operator=(Ball&& other) noexcept {
    state_ = other.state_;
    arb_swap(x_, other.x_);
    return *this;
  }
  ~Ball() { arb_clear(x_); }

  State state() const { return state_; }
  bool is(State state) const { return state_ == state; }
  arb_ptr get() { return x_; }
  arb_srcptr get() const { return x_; }

  bool certainly_outside(double lo, double hi) const {
    return is(State::number) && (certainly_below(lo) || certainly_above(hi));
  }
  double nearest() const { return is(State::number) ? arf_get_d(arb_midref(x_), ARF_RND_NEAR) : NAN; }

  // What overflowed even here is not known.
  Ball checked() && {
    if (is(State::number) && !arb_is_finite(x_)) state_ = State::unknown;
    return std::move(*this);
  }

 private:
  bool certainly_below(double end) const {
    return end == INFINITY || (std::isfinite(end) && compare(end) < 0);
  }
  bool certainly_above(double end) const {
    return end == -INFINITY || (std::isfinite(end) && compare(end) > 0);
  }

  int compare(double end) const {  // 0 where the two touch
    const Ball other(end);
    return arb_lt(x_, other.x_) ? -1 : arb_gt(x_, other.x_) ? 1 : 0;
  }

  State state_;
  arb_t x_;
};

// One rule an op, by its meaning on real numbers: what has no value is none of them.
struct BallRules {
  using Value = Ball;
  using State = Ball::State;
  static constexpr slong precision = Ball::precision;

  template <class Function, class... Args>
  static Ball call(Function function, const Args&... args) {
    if ((args.is(State::none) || ...)) return Ball(State::none);
    if ((args.is(State::unknown) || ...)) return Ball(State::unknown);
    Ball result(State::number);
    function(result.get(), args.get()..., precision);
    return std::move(result).checked();
  }
  // Of a function that is defined where `inside` holds and not where `outside` does.
  template <class Function>
  static Ball where(bool inside, bool outside, Function function, const Ball& a) {
    if (!a.is(State::number)) return Ball(a.state());
    return inside ? call(function, a) : Ball(outside ? State::none : State::unknown);
  }
  static bool at_least(const Ball& a, double end) { return arb_ge(a.get(), Ball(end).get()) != 0; }
  static bool at_most(const Ball& a, double end) { return arb_le(a.get(), Ball(end).get()) != 0; }
  static bool above(const Ball& a, double end) { return arb_gt(a.get(), Ball(end).get()) != 0; }
  static bool below(const Ball& a, double end) { return arb_lt(a.get(), Ball(end).get()) != 0; }

  Ball add(const Ball& a, const Ball& b) { return call(arb_add, a, b); }
  Ball sub(const Ball& a, const Ball& b) { return call(arb_sub, a, b); }
  Ball mul(const Ball& a, const Ball& b) { return call(arb_mul, a, b); }
  Ball div(const Ball& a, const Ball& b) {
    return b.is(State::number) && arb_is_zero(b.get()) ? Ball(State::none) : call(arb_div, a, b);
  }
  Ball fma(const Ball& a, const Ball& b, const Ball& c) { return add(mul(a, b), c); }
  Ball neg(const Ball& a) { return unrounded(arb_neg, a); }
  Ball abs(const Ball& a) { return unrounded(arb_abs, a); }
  Ball sign(const Ball& a) { return unrounded(arb_sgn, a); }
  Ball floor(const Ball& a) { return call(arb_floor, a); }
  Ball ceil(const Ball& a) { return call(arb_ceil, a); }
  Ball mod(const Ball& a, const Ball& b) { return sub(a, mul(b, floor(div(a, b)))); }
  Ball min(const Ball& a, const Ball& b) { return or_second(arb_min, a, b); }
  Ball max(const Ball& a, const Ball& b) { return or_second(arb_max, a, b); }
  Ball sqrt(const Ball& a) { return where(at_least(a, 0), below(a, 0), arb_sqrt, a); }
  Ball powi(const Ball& a, const Ball& n) {
    const double exponent = n.nearest();
    const auto power = [&](arb_ptr r, arb_srcptr x, slong bits) {
      arb_pow_ui(r, x, static_cast<ulong>(std::abs(exponent)), bits);
    };
    if (exponent == 0) return a.is(State::number) ? Ball(1.0) : a;
    return exponent > 0 ? call(power, a) : div(Ball(1.0), call(power, a));
  }

  Ball chebyshev(const Ball& a, const Ball& degree, const Ball& order) {
    const auto n = static_cast<ulong>(degree.nearest());
    const auto polynomial = [n](arb_ptr r, arb_srcptr x, slong bits) { arb_chebyshev_t_ui(r, n, x, bits); };
    const auto slope = [n](arb_ptr r, arb_srcptr x, slong bits) {
      arb_chebyshev_u_ui(r, n - 1, x, bits);
      arb_mul_ui(r, r, n, bits);
    };
    if (order.nearest() > 1) return Ball(State::unknown);
    return order.nearest() == 0 ? call(polynomial, a) : call(slope, a);
  }

  Ball exp(const Ball& a) { return call(arb_exp, a); }
  Ball log(const Ball& a) { return where(above(a, 0), at_most(a, 0), arb_log, a); }
  Ball sin(const Ball& a) { return call(arb_sin, a); }
  Ball cos(const Ball& a) { return call(arb_cos, a); }
  Ball tan(const Ball& a) { return call(arb_tan, a); }
  Ball asin(const Ball& a) { return in_unit(arb_asin, a); }
  Ball acos(const Ball& a) { return in_unit(arb_acos, a); }
  Ball atan(const Ball& a) { return call(arb_atan, a); }
  Ball sinh(const Ball& a) { return call(arb_sinh, a); }
  Ball cosh(const Ball& a) { return call(arb_cosh, a); }
  Ball tanh(const Ball& a) { return call(arb_tanh, a); }
  Ball asinh(const Ball& a) { return call(arb_asinh, a); }
  Ball acosh(const Ball& a) { return where(at_least(a, 1), below(a, 1), arb_acosh, a); }
  Ball atanh(const Ball& a) {
    return where(above(a, -1) && below(a, 1), at_most(a, -1) || at_least(a, 1), arb_atanh, a);
  }
  Ball cbrt(const Ball& a) {
    const auto root = [](arb_ptr r, arb_srcptr x, slong bits) { arb_root_ui(r, x, 3, bits); };
    if (!a.is(State::number)) return a;
    if (at_most(a, 0)) return neg(call(root, neg(a)));
    return where(at_least(a, 0), false, root, a);
  }
  // 0^0 is 1, and below 0 there is no real power.
  Ball pow(const Ball& a, const Ball& b) {
    if (!a.is(State::number) || !b.is(State::number)) return call(arb_pow, a, b);
    if (below(a, 0)) return Ball(State::none);
    if (above(a, 0)) return call(arb_pow, a, b);
    if (!arb_is_zero(a.get())) return Ball(State::unknown);
    if (arb_is_zero(b.get())) return Ball(1.0);
    return above(b, 0) ? Ball(0.0) : Ball(below(b, 0) ? State::none : State::unknown);
  }
  Ball atan2(const Ball& y, const Ball& x) { return call(arb_atan2, y, x); }

  Ball lt(const Ball& a, const Ball& b) {
    return decide(a, b, arb_lt(a.get(), b.get()), arb_ge(a.get(), b.get()));
  }
  Ball le(const Ball& a, const Ball& b) {
    return decide(a, b, arb_le(a.get(), b.get()), arb_gt(a.get(), b.get()));
  }
  Ball eq(const Ball& a, const Ball& b) {
    return decide(a, b, arb_eq(a.get(), b.get()), arb_ne(a.get(), b.get()));
  }
  Ball and_(const Ball& a, const Ball& b) {
    if (a.is(State::no) || b.is(State::no)) return Ball(State::no);
    return Ball(a.is(State::yes) && b.is(State::yes) ? State::yes : State::unknown);
  }
  Ball not_(const Ball& a) {
    return Ball(a.is(State::yes) ? State::no : a.is(State::no) ? State::yes : State::unknown);
  }
  Ball or_(const Ball& a, const Ball& b) { return not_(and_(not_(a), not_(b))); }
  Ball select(const Ball& c, const Ball& a, const Ball& b) {
    return c.is(State::yes) ? a : c.is(State::no) ? b : Ball(State::unknown);
  }

 private:
  template <class Function>
  static Ball unrounded(Function function, const Ball& a) {
    return call([&](arb_ptr r, arb_srcptr x, slong) { function(r, x); }, a);
  }
  template <class Function>
  static Ball in_unit(Function function, const Ball& a) {
    return where(at_least(a, -1) && at_most(a, 1), below(a, -1) || above(a, 1), function, a);
  }
  template <class Function>
  static Ball or_second(Function function, const Ball& a, const Ball& b) {  // of an operand without a value
    return a.is(State::none) || b.is(State::none) ? b : call(function, a, b);
  }
  static Ball decide(const Ball& a, const Ball& b, int yes, int no) {
    if (a.is(State::none) || b.is(State::none)) return Ball(State::no);
    if (a.is(State::unknown) || b.is(State::unknown)) return Ball(State::unknown);
    return Ball(yes ? State::yes : no ? State::no : State::unknown);
  }
};

// The outputs of `f` (f64, constants unresolved) at finite numbers. Throws on an op without a rule.
inline std::vector<Ball> ball_values(const Program& f, std::span<const double> inputs) {
  BallRules rules;
  std::vector<Ball> values, args;
  values.reserve(f.graph.size());
  for (std::uint32_t i = 0; i < f.graph.size(); ++i) {
    const Node node = f.graph[Id{i}];
    if (node.op == Op::input) {
      values.emplace_back(inputs[node.payload] + 0.0);
    } else if (node.op == Op::constant) {
      if (node.type.is_truth())
        values.emplace_back(node.payload != 0 ? Ball::State::yes : Ball::State::no);
      else
        values.push_back(Ball(f.graph.number(Id{i}).value_or(NAN)).checked());
    } else {
      args.clear();
      for (const Id arg : node.args) args.push_back(values[arg.index]);
      auto value = apply(rules, node.op, std::span<const Ball>(args));
      if (!value) throw std::runtime_error("no ball rule for " + std::string(info(node.op).name));
      values.push_back(*std::move(value));
    }
  }
  std::vector<Ball> result;
  for (const Output& output : f.outputs) result.push_back(values[output.id.index]);
  return result;
}

}  // namespace imp::test
