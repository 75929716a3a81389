// A formula over sets of real numbers.
#pragma once

#include <gmpxx.h>

#include <map>
#include <optional>
#include <span>

#include "tests/support/expression.h"
#include "tests/support/real_set.h"

namespace imp::test {

// The exact value of a number's text.
inline mpq_class exact_number(const std::string& text) {
  const std::size_t e = text.find_first_of("eE");
  std::string digits = text.substr(0, e);
  long exponent = e == std::string::npos ? 0 : std::stol(text.substr(e + 1));
  if (const std::size_t point = digits.find('.'); point != std::string::npos) {
    exponent -= static_cast<long>(digits.size() - point - 1);
    digits.erase(point, 1);
  }
  mpz_class power;
  mpz_ui_pow_ui(power.get_mpz_t(), 10, static_cast<unsigned long>(std::abs(exponent)));
  mpq_class value(mpz_class(digits.empty() ? "0" : digits, 10));
  exponent < 0 ? value /= power : value *= power;
  return value;
}

// The rational that a constant is; nothing where it is none, or not by arithmetic alone.
inline std::optional<mpq_class> exact_constant(const Expression& e) {
  if (e.is_number()) return exact_number(e.name);
  std::vector<mpq_class> args;
  for (const Expression& arg : e.args)
    if (const auto value = exact_constant(arg))
      args.push_back(*value);
    else
      return std::nullopt;
  const auto floor = [](const mpq_class& x) {
    mpz_class q;
    mpz_fdiv_q(q.get_mpz_t(), x.get_num_mpz_t(), x.get_den_mpz_t());
    return mpq_class(q);
  };
  if (e.is("-", 1)) return mpq_class(-args[0]);
  if (e.is("abs", 1)) return mpq_class(::abs(args[0]));
  if (e.is("floor", 1)) return floor(args[0]);
  if (e.is("ceil", 1)) return mpq_class(-floor(-args[0]));
  if (args.size() != 2) return std::nullopt;
  if (e.name == "+") return mpq_class(args[0] + args[1]);
  if (e.name == "-") return mpq_class(args[0] - args[1]);
  if (e.name == "*") return mpq_class(args[0] * args[1]);
  if (e.name == "min") return std::min(args[0], args[1]);
  if (e.name == "max") return std::max(args[0], args[1]);
  if (args[1] == 0) return std::nullopt;
  if (e.name == "/") return mpq_class(args[0] / args[1]);
  if (e.name == "mod") return mpq_class(args[0] - args[1] * floor(args[0] / args[1]));
  return std::nullopt;
}

// What a formula is over a piece of its arguments: all of it is proven, and "may" says that nothing is.
struct Outcome {
  bool may_be_zero = false, may_be_below = false, may_be_above = false;
  bool nowhere = true;                     // no value at all
  bool defined = true, continuous = true;  // everywhere on the piece
  bool pole = false;
  Real lo = infinite(Toward::above), hi = infinite(Toward::below);

  bool has_sign() const { return defined && !may_be_zero && may_be_below != may_be_above; }
  int sign() const { return has_sign() ? (may_be_above ? 1 : -1) : 0; }
  bool is_zero() const { return defined && lo.sign() == 0 && hi.sign() == 0; }
};

// Compiled for many evaluations: equal parts are one.
class RealFunction {
 public:
  // The arguments by name, in the order of inputs. Throws where the text means nothing.
  RealFunction(const Expression& e, const std::vector<std::string>& variables) {
    for (const std::string& name : variables)
      names_.emplace(name, add({Kind::variable, names_.size(), {}, {}}));
    inputs_ = variables.size();
    root_ = compile(e);
  }

  Outcome operator()(std::span<const RealSet> inputs) const {
    Outcome outcome;
    Choices choices;
    std::vector<RealSet> values(nodes_.size());
    std::size_t ways = 0;
    do {
      if (++ways > most_ways) return unknown();
      const RealSet value = run(inputs, values, choices);
      outcome.defined &= value.defined;
      outcome.continuous &= value.continuous && value.defined;
      outcome.pole |= value.pole;
      if (!value.is_empty()) {
        outcome.nowhere = false;
        outcome.may_be_zero |= value.may_be_zero();
        outcome.may_be_below |= value.lo.sign() < 0;
        outcome.may_be_above |= value.hi.sign() > 0;
        outcome.lo = std::min(outcome.lo, value.lo), outcome.hi = std::max(outcome.hi, value.hi);
      }
    } while (choices.next());
    return outcome;
  }
  std::size_t inputs() const { return inputs_; }
  bool jumps() const {
    return jumps_;
  }  // whether it holds a function that is not continuous where it is defined

 private:
  static constexpr std::size_t most_ways = 48;
  static constexpr std::size_t most_nodes = 20'000;

  enum class Kind : std::uint8_t { variable, number, power, chebyshev, call };
  struct Step {
    Kind kind;
    std::size_t number;  // of the variable; the exponent or degree
    std::string name;    // of a call
    std::vector<std::size_t> args;
    auto operator<=>(const Step&) const = default;
  };

  static Outcome unknown() {
    Outcome all;
    all.may_be_zero = all.may_be_below = all.may_be_above = all.pole = true;
    all.nowhere = all.defined = all.continuous = false;
    all.lo = infinite(Toward::below), all.hi = infinite(Toward::above);
    return all;
  }

  std::size_t add(const Step& step) {
    const auto [it, fresh] = known_.try_emplace(step, nodes_.size());
    if (fresh) nodes_.push_back(step), constants_.emplace_back();
    if (nodes_.size() > most_nodes) throw std::runtime_error("too long for the reference");
    return it->second;
  }
  std::size_t add_constant(const mpq_class& value) {
    const std::size_t at = add({Kind::number, 0, value.get_str(), {}});
    fmpq_t q;
    fmpq_init(q);
    fmpq_set_mpq(q, value.get_mpq_t());
    arb_t ball;
    arb_init(ball);
    arb_set_fmpq(ball, q, Real::precision);
    arb_get_interval_arf(constants_[at].lo.get(), constants_[at].hi.get(), ball, Real::precision);
    arb_clear(ball);
    fmpq_clear(q);
    return at;
  }

  // A constant with the indices of sums put in.
  std::optional<mpq_class> constant(const Expression& e) const { return exact_constant(bound(e)); }
  Expression bound(const Expression& e) const {
    if (e.args.empty())
      if (const auto it = indices_.find(e.name); it != indices_.end()) return it->second;
    Expression result{e.name, {}};
    for (const Expression& arg : e.args) result.args.push_back(bound(arg));
    return result;
  }
  long integer(const Expression& e) const {
    const auto value = constant(e);
    if (!value || value->get_den() != 1) throw std::runtime_error("no whole constant: " + to_text(e));
    return value->get_num().get_si();
  }

  std::size_t compile(const Expression& e) {
    if (e.args.empty()) return leaf(e);
    if ((e.is("^", 2) || e.is("pow", 2)))
      if (const auto n = constant(e.args[1]); n && n->get_den() == 1)
        return add({Kind::power, static_cast<std::size_t>(n->get_num().get_si()), {}, {compile(e.args[0])}});
    if (e.is("T", 2))
      return add({Kind::chebyshev, static_cast<std::size_t>(integer(e.args[0])), {}, {compile(e.args[1])}});
    if (e.is("sum", 4) || e.is("product", 4)) return series(e);
    if (e.name == "min" || e.name == "max") {
      std::size_t result = compile(e.args[0]);
      for (std::size_t i = 1; i < e.args.size(); ++i)
        result = add({Kind::call, 0, e.name, {result, compile(e.args[i])}});
      return result;
    }
    for (const char* name : {"floor", "ceil", "sign", "mod", "if", "atan2"}) jumps_ |= e.name == name;
    Step step{Kind::call, 0, e.name == "^" ? "pow" : e.name, {}};
    for (const Expression& arg : e.args) step.args.push_back(compile(arg));
    return add(step);
  }
  std::size_t leaf(const Expression& e) {
    if (e.is_number()) return add_constant(exact_number(e.name));
    if (const auto it = indices_.find(e.name); it != indices_.end()) return compile(it->second);
    if (const auto it = names_.find(e.name); it != names_.end()) return it->second;
    if (e.name == "pi") return add({Kind::call, 0, "pi", {}});
    throw std::runtime_error("unknown name " + e.name);
  }
  std::size_t series(const Expression& e) {
    const std::string index = e.args[0].name;
    const long first = integer(e.args[1]), last = integer(e.args[2]);
    const auto outer = indices_;
    const bool sum = e.name == "sum";
    std::optional<std::size_t> total;
    for (long i = first; i <= last; ++i) {
      const Expression number{std::to_string(std::abs(i)), {}};
      indices_[index] = i < 0 ? Expression{"-", {number}} : number;
      const std::size_t term = compile(e.args[3]);
      total = total ? add({Kind::call, 0, sum ? "+" : "*", {*total, term}}) : term;
    }
    indices_ = outer;
    return total ? *total : add_constant(sum ? 0 : 1);
  }

  RealSet run(std::span<const RealSet> inputs, std::vector<RealSet>& values, Choices& choices) const {
    RealRules rules(choices);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const Step& step = nodes_[i];
      switch (step.kind) {
        case Kind::variable: values[i] = inputs[step.number]; break;
        case Kind::number:   values[i] = constants_[i]; break;
        case Kind::power:
          values[i] = rules.power(values[step.args[0]], static_cast<long>(step.number));
          break;
        case Kind::chebyshev: values[i] = rules.chebyshev(values[step.args[0]], step.number); break;
        case Kind::call:      values[i] = call(rules, step, values); break;
      }
    }
    return values[root_];
  }

  static RealSet call(RealRules& rules, const Step& step, const std::vector<RealSet>& values) {
    using One = RealSet (*)(RealRules&, const RealSet&);
    using Two = RealSet (*)(RealRules&, const RealSet&, const RealSet&);
#define IMP_ONE(name) {#name, [](RealRules& r, const RealSet& a) { return r.name(a); }}
#define IMP_TWO(text, call) {text, [](RealRules& r, const RealSet& a, const RealSet& b) { return r.call; }}
    static const std::map<std::string, One, std::less<>> ones{
        IMP_ONE(abs),
        IMP_ONE(sign),
        IMP_ONE(floor),
        IMP_ONE(ceil),
        IMP_ONE(sqrt),
        IMP_ONE(cbrt),
        IMP_ONE(exp),
        IMP_ONE(log),
        IMP_ONE(sinh),
        IMP_ONE(cosh),
        IMP_ONE(tanh),
        IMP_ONE(asinh),
        IMP_ONE(acosh),
        IMP_ONE(atanh),
        IMP_ONE(asin),
        IMP_ONE(acos),
        IMP_ONE(atan),
        IMP_ONE(sin),
        IMP_ONE(cos),
        IMP_ONE(tan),
        {"-", [](RealRules& r, const RealSet& a) { return r.neg(a); }},
        {"not", [](RealRules& r, const RealSet& a) { return r.negation(a); }}};
    static const std::map<std::string, Two, std::less<>> twos{
        IMP_TWO("+", add(a, b)),         IMP_TWO("-", sub(a, b)),          IMP_TWO("*", mul(a, b)),
        IMP_TWO("/", div(a, b)),         IMP_TWO("mod", mod(a, b)),        IMP_TWO("min", min(a, b)),
        IMP_TWO("max", max(a, b)),       IMP_TWO("pow", pow(a, b)),        IMP_TWO("atan2", atan2(a, b)),
        IMP_TWO("<", less(a, b, false)), IMP_TWO("<=", less(a, b, true)),  IMP_TWO(">", less(b, a, false)),
        IMP_TWO(">=", less(b, a, true)), IMP_TWO("and", both(a, b, true)), IMP_TWO("or", both(a, b, false))};
#undef IMP_ONE
#undef IMP_TWO
    const auto arg = [&](std::size_t i) -> const RealSet& { return values[step.args[i]]; };
    if (step.args.empty()) return rules.pi();
    if (step.args.size() == 3 && step.name == "if") return rules.select(arg(0), arg(1), arg(2));
    if (step.args.size() == 1)
      if (const auto it = ones.find(step.name); it != ones.end()) return it->second(rules, arg(0));
    if (step.args.size() == 2)
      if (const auto it = twos.find(step.name); it != twos.end()) return it->second(rules, arg(0), arg(1));
    throw std::runtime_error("no function " + step.name);
  }

  std::size_t inputs_ = 0, root_ = 0;
  bool jumps_ = false;
  std::vector<Step> nodes_;
  std::vector<RealSet> constants_;  // by node
  std::map<Step, std::size_t> known_;
  std::map<std::string, std::size_t, std::less<>> names_;
  std::map<std::string, Expression, std::less<>> indices_;
};

}  // namespace imp::test
