// Symbolic differentiation: the chain rule, one line an op.
#include "passes/differentiate.h"

#include <cmath>
#include <string>

#include "ir/chebyshev.h"
#include "ir/expr.h"
#include "ir/replay.h"
#include "passes/rewrite.h"

namespace imp {
namespace {

// A derivative that is not zero everywhere: `value` where `live`, and 0 elsewhere, whatever `value`
// is there. No Slope is a derivative that is zero everywhere.
struct Slope {
  Expr value;
  Truth live;
};
using Derivative = std::optional<Slope>;

Truth always(Expr like) { return truth_of(*like.graph, true); }
bool is_always(Truth t) { return t.graph->truth_value(t.id) == true; }
Expr resolved(Slope s) { return is_always(s.live) ? s.value : select(s.live, s.value, zero(s.value)); }

Derivative operator-(const Derivative& d) { return d ? Derivative({-d->value, d->live}) : std::nullopt; }

Derivative operator*(const Derivative& d, Expr factor) {
  return d ? Derivative({d->value * factor, d->live}) : std::nullopt;
}

Derivative operator/(const Derivative& d, Expr divisor) {
  return d ? Derivative({d->value / divisor, d->live}) : std::nullopt;
}

template <class Join>
Derivative joined(const Slope& a, const Slope& b, Join join) {
  if (a.live.id == b.live.id) return Slope{join(a.value, b.value), a.live};
  return Slope{join(resolved(a), resolved(b)), a.live || b.live};
}

Derivative operator+(const Derivative& a, const Derivative& b) {
  if (!a || !b) return a ? a : b;
  return joined(*a, *b, [](Expr p, Expr q) { return p + q; });
}

Derivative operator-(const Derivative& a, const Derivative& b) {
  if (!a || !b) return a ? a : -b;
  return joined(*a, *b, [](Expr p, Expr q) { return p - q; });
}

// Where c the one, else the other.
Derivative either(Truth c, const Derivative& a, const Derivative& b) {
  if (!a && !b) return std::nullopt;
  if (!b) return Slope{a->value, c && a->live};
  if (!a) return Slope{b->value, !c && b->live};
  const Truth live = a->live.id == b->live.id ? a->live : select(c, a->live, b->live);
  return Slope{select(c, a->value, b->value), live};
}

// A node and its derivative with respect to the input at hand.
struct Dual {
  Expr value;
  Derivative d;
  Truth truth() const { return {value.graph, value.id}; }  // of a node that is one
};

struct DerivativeRules {
  using Value = Dual;
  Expr node;             // the one that is differentiated
  bool refused = false;  // it has a derivative that no op is

  Dual is(const Derivative& d) const { return {node, d}; }
  Dual flat() const { return {node, std::nullopt}; }

  Dual add(Dual a, Dual b) { return is(a.d + b.d); }
  Dual sub(Dual a, Dual b) { return is(a.d - b.d); }
  Dual mul(Dual a, Dual b) {
    if (a.value == b.value) return is(a.d * (2.0 * a.value));
    return is(a.d * b.value + b.d * a.value);
  }
  Dual div(Dual a, Dual b) { return is((a.d - b.d * node) / b.value); }
  Dual fma(Dual a, Dual b, Dual c) { return is(mul(a, b).d + c.d); }
  Dual neg(Dual a) { return is(-a.d); }
  Dual abs(Dual a) { return is(either(a.value < 0.0, -a.d, a.d)); }
  Dual min(Dual a, Dual b) { return is(either(a.value < b.value, a.d, b.d)); }
  Dual max(Dual a, Dual b) { return is(either(b.value < a.value, a.d, b.d)); }
  Dual select(Dual c, Dual a, Dual b) { return is(either(c.truth(), a.d, b.d)); }

  Dual floor(Dual) { return flat(); }
  Dual ceil(Dual) { return flat(); }
  Dual sign(Dual) { return flat(); }
  Dual mod(Dual a, Dual b) { return is(b.d ? a.d - b.d * imp::floor(a.value / b.value) : a.d); }

  Dual powi(Dual a, Dual b) {
    const double n = number(b.value).value_or(0);
    if (n == 0) return flat();
    if (n == 1) return is(a.d);
    return is(a.d * (n * less_one(a.value, n)));
  }
  Dual chebyshev(Dual a, Dual degree, Dual order) {
    const double k = number(order.value).value_or(0) + 1;
    if (k > number(degree.value).value_or(0)) return flat();
    refused = k > largest_chebyshev_order;
    return refused ? flat() : is(a.d * make(Op::chebyshev, a.value, degree.value, constant_like(a.value, k)));
  }
  Dual pow(Dual a, Dual b) {
    Derivative by_base = a.d, by_exponent;
    if (a.d && number(b.value) == 0.0) by_base = std::nullopt;
    if (a.d && number(b.value) != 1.0) by_base = by_base * (b.value * power(a.value, b.value - 1.0));
    if (b.d) {
      by_exponent = b.d * (node * make(Op::log, a.value));
      by_exponent->live = by_exponent->live && !equal(a.value, zero(a.value));  // 0^b is 0: no 0*log 0
    }
    return is(by_base + by_exponent);
  }
  Dual sqrt(Dual a) { return is(a.d / (2.0 * node)); }
  Dual cbrt(Dual a) { return is(a.d / (3.0 * (node * node))); }
  Dual exp(Dual a) { return is(a.d * node); }
  Dual log(Dual a) { return is(a.d / a.value); }

  Dual sin(Dual a) { return is(a.d * make(Op::cos, a.value)); }
  Dual cos(Dual a) { return is(-(a.d * make(Op::sin, a.value))); }
  Dual tan(Dual a) { return is(a.d * (1.0 + node * node)); }
  Dual asin(Dual a) { return is(a.d / imp::sqrt((1.0 - a.value) * (1.0 + a.value))); }
  Dual acos(Dual a) { return is(-(a.d / imp::sqrt((1.0 - a.value) * (1.0 + a.value)))); }
  Dual atan(Dual a) { return is(a.d / (1.0 + a.value * a.value)); }
  Dual atan2(Dual y, Dual x) {
    return is((y.d * x.value - x.d * y.value) / (x.value * x.value + y.value * y.value));
  }
  Dual sinh(Dual a) { return is(a.d * make(Op::cosh, a.value)); }
  Dual cosh(Dual a) { return is(a.d * make(Op::sinh, a.value)); }
  Dual tanh(Dual a) { return is(a.d * (1.0 - node * node)); }
  Dual asinh(Dual a) { return is(a.d / imp::sqrt(a.value * a.value + 1.0)); }
  Dual acosh(Dual a) { return is(a.d / imp::sqrt((a.value - 1.0) * (a.value + 1.0))); }
  Dual atanh(Dual a) { return is(a.d / ((1.0 - a.value) * (1.0 + a.value))); }

  Dual widen(Dual a) { return is(converted(a.d, Op::widen)); }
  Dual narrow(Dual a) { return is(converted(a.d, Op::narrow)); }

 private:
  static std::optional<double> number(Expr e) { return e.graph->number(e.id); }

  // a^(n - 1), and no powers 0 and 1.
  static Expr less_one(Expr a, double n) {
    constexpr double limit = 1 << 20;  // of exponents
    if (n == 2) return a;
    if (n == -limit) return make(Op::powi, a, constant_like(a, n)) / a;
    return make(Op::powi, a, constant_like(a, n - 1));
  }
  static Expr power(Expr a, Expr b) { return number(b) == 1.0 ? a : make(Op::pow, a, b); }
  static Derivative converted(const Derivative& d, Op op) {
    return d ? Derivative({make(op, d->value), d->live}) : std::nullopt;
  }
};

// Derivatives of nodes of one Program, which grows by them. The nodes of `roots` must be there when
// it is made.
class Differentiator {
 public:
  Differentiator(Program& program, std::vector<Id> roots, Diagnostics& diagnostics)
      : graph_(program.graph), diagnostics_(diagnostics), needed_(graph_.size()) {
    for (Id root : roots) needed_[root.index] = true;
    for (std::size_t i = needed_.size(); i-- > 0;)
      if (needed_[i])
        for (Id arg : graph_[Id{static_cast<std::uint32_t>(i)}].args) needed_[arg.index] = true;
  }

  // Of every needed node with respect to `input`, then read by `of`. False after an error.
  bool run(Id input) {
    derivatives_.assign(needed_.size(), std::nullopt);
    bool good = true;
    for (std::uint32_t i = 0; i < needed_.size(); ++i) {
      if (!needed_[i]) continue;
      const Id id{i};
      const std::size_t before = graph_.size();
      if (id == input) {
        const Expr x{&graph_, id};
        derivatives_[i] = Slope{one(x), always(x)};
      } else if (!derive(id)) {
        good = false;
      }
      for (std::size_t k = before; k < graph_.size(); ++k)
        graph_.set_span(Id{static_cast<std::uint32_t>(k)}, graph_.span(id));
    }
    return good;
  }

  Id of(Id root) {
    const auto& d = derivatives_[root.index];
    return (d ? resolved(*d) : zero({&graph_, root})).id;
  }

 private:
  bool derive(Id id) {
    const Node node = graph_[id];
    if (node.type.is_truth()) return true;
    const bool hidden = node.op == Op::state || node.op == Op::result;  // a loop, not looked into
    const std::vector<Id> ids(node.args.begin(), node.args.end());      // the graph is about to grow
    std::vector<Dual> args;
    bool flat = !hidden;
    for (Id arg : ids) {
      args.push_back({{&graph_, arg}, derivatives_[arg.index]});
      flat = flat && !derivatives_[arg.index];
    }
    if (flat) return true;

    DerivativeRules rules{{&graph_, id}};
    if (const auto dual = apply(rules, node.op, args); dual && !rules.refused) {
      derivatives_[id.index] = is_zero(dual->d) ? std::nullopt : dual->d;
      return true;
    }
    diagnostics_.error(graph_.span(id), "'" + std::string(info(node.op).name) + "' has no derivative");
    return false;
  }

  bool is_zero(const Derivative& d) const {
    return d && (graph_.number(d->value.id) == 0.0 || graph_.truth_value(d->live.id) == false);
  }

  Graph& graph_;
  Diagnostics& diagnostics_;
  std::vector<bool> needed_;
  std::vector<Derivative> derivatives_;
};

std::vector<Id> ids_of(const std::vector<Output>& outputs) {
  std::vector<Id> ids;
  ids.reserve(outputs.size());
  for (const Output& output : outputs) ids.push_back(output.id);
  return ids;
}

constexpr std::string_view coordinates[] = {"x", "y", "z"};

}  // namespace

std::optional<Program> differentiate(const Program& program, std::span<const std::string_view> inputs,
                                     Diagnostics& diagnostics) {
  Program result = program;
  Differentiator differentiator(result, ids_of(program.outputs), diagnostics);
  std::vector<std::vector<Output>> slopes(program.outputs.size());  // of each output
  for (const std::string_view name : inputs) {
    const Input* input = program.input(name);
    if (!input || !input->type.is_real()) {
      diagnostics.error("'" + std::string(name) + "' is not an input that is a number");
      return std::nullopt;
    }
    if (!differentiator.run(input->id)) return std::nullopt;
    for (std::size_t i = 0; i < program.outputs.size(); ++i) {
      const Output& output = program.outputs[i];
      slopes[i].push_back({output.name + std::string(name), differentiator.of(output.id)});
    }
  }
  for (const auto& of_one : slopes) result.outputs.insert(result.outputs.end(), of_one.begin(), of_one.end());
  return compact(result);
}

std::optional<Program> gradient(const Program& f, Diagnostics& diagnostics) {
  return differentiate(f, coordinates, diagnostics);
}

std::optional<Program> hessian(const Program& f, Diagnostics& diagnostics) {
  auto result = gradient(f, diagnostics);
  if (!result) return std::nullopt;
  std::vector<Output> slopes(result->outputs.end() - 3, result->outputs.end());  // fx, fy, fz
  Differentiator differentiator(*result, ids_of(slopes), diagnostics);
  std::vector<std::vector<Output>> second(3);
  for (std::size_t k = 0; k < 3; ++k) {
    if (!differentiator.run(result->input(coordinates[k])->id)) return std::nullopt;
    for (std::size_t i = 0; i <= k; ++i)
      second[i].push_back({slopes[i].name + std::string(coordinates[k]), differentiator.of(slopes[i].id)});
  }
  for (const auto& row : second) result->outputs.insert(result->outputs.end(), row.begin(), row.end());
  return compact(*result);
}

}  // namespace imp
