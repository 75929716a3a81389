#include "passes/fraction.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "ir/expr.h"
#include "passes/range.h"
#include "passes/rewrite.h"

namespace imp {
namespace {

// With more divisors the numerator grows beyond what an enclosure gains.
constexpr std::size_t most_divisors = 4;
constexpr unsigned most_factors = 8;

using Powers = std::map<std::uint32_t, unsigned>;  // of divisors, by the index of the node

struct Quotient {
  Expr above;
  Powers below;
  std::set<std::uint32_t> poles{};  // every divisor there has been: x in 1/(1/x)
};

std::set<std::uint32_t> both(std::set<std::uint32_t> a, const std::set<std::uint32_t>& b) {
  a.insert(b.begin(), b.end());
  return a;
}

class Fractions {
 public:
  explicit Fractions(const Program& f)
      : old_(f), live_(live_nodes(f)), known_(ranges(f, std::vector<Range>(f.inputs.size(), everything))) {}

  Fraction operator()() {
    const Graph& old = old_.graph;
    Program whole{.name = old_.name, .inputs = old_.inputs};
    graph_ = &whole.graph;
    plain_.resize(old.size());
    quotients_.resize(old.size());
    varies_.resize(old.size());
    for (std::uint32_t i = 0; i < old.size(); ++i) {
      if (!live_[i]) continue;
      const Node node = old[Id{i}];
      std::vector<Id> args;
      for (const Id arg : node.args) args.push_back(plain_[arg.index]);
      plain_[i] = rebuild(*graph_, node, args, node.payload);
      graph_->set_span(plain_[i], old.span(Id{i}));
      varies_[i] = std::ranges::any_of(node.args, [&](Id id) { return varies(id); });
      quotients_[i] = quotient(node, expr(plain_[i]));
    }
    for (Input& input : whole.inputs) input.id = plain_[input.id.index];

    const Quotient& f = quotients_[old_.outputs[0].id.index];
    unsigned factors = 0;
    for (const auto& [divisor, power] : f.below) factors += power;
    if (f.poles.empty() || f.poles.size() > most_divisors || factors > most_factors)
      return {old_, std::nullopt};

    std::optional<Expr> poles;
    for (const std::uint32_t divisor : f.poles) {
      const Expr each = expr(Id{divisor});
      poles = poles ? *poles * each : each;
    }
    return {with_output(whole, old_.outputs[0].name, f.above), with_output(whole, "poles", *poles)};
  }

 private:
  static Program with_output(Program program, const std::string& name, Expr value) {
    program.outputs = {{name, value.id}};
    return rewrite(program, [](Graph& graph, Id, const Node& node) { return copy(graph, node); });
  }

  Expr expr(Id id) const { return {graph_, id}; }
  Expr plain(const Node& old, std::size_t i) const { return expr(plain_[old.args[i].index]); }
  const Quotient& operand(const Node& old, std::size_t i) const { return quotients_[old.args[i].index]; }

  bool varies(Id old) const {
    const Node node = old_.graph[old];
    return node.op == Op::input ? node.payload < 3 : varies_[old.index];
  }
  bool changes_sign(Id old) const {
    const auto& range = known_[old.index];
    return varies(old) && range && range->lo < 0 && range->hi > 0;
  }

  Expr product(Expr first, const Powers& powers) const {
    for (const auto& [divisor, power] : powers) first = first * to_power(expr(Id{divisor}), power);
    return first;
  }
  static Expr to_power(Expr base, unsigned power) {
    return power == 1 ? base : make(Op::powi, base, constant_like(base, power));
  }

  static Powers product(Powers a, const Powers& b) {
    for (const auto& [divisor, power] : b) a[divisor] += power;
    return a;
  }
  static Powers times(Powers a, unsigned power) {
    for (auto& [divisor, each] : a) each *= power;
    return a;
  }
  static Powers least_common(Powers a, const Powers& b) {
    for (const auto& [divisor, power] : b) a[divisor] = std::max(a[divisor], power);
    return a;
  }
  static Powers without(const Powers& a, const Powers& b) {
    Powers result;
    for (const auto& [divisor, power] : a) {
      const auto found = b.find(divisor);
      const unsigned left = power - (found == b.end() ? 0 : found->second);
      if (left != 0) result[divisor] = left;
    }
    return result;
  }

  // a/b, where b changes its sign.
  Quotient over(const Quotient& a, const Quotient& b) const {
    Quotient result{product(a.above, b.below), a.below, both(a.poles, b.poles)};
    ++result.below[b.above.id.index];
    result.poles.insert(b.above.id.index);
    return result;
  }

  Quotient sum(const Quotient& a, const Quotient& b, Op op) const {
    const Powers below = least_common(a.below, b.below);
    return {make(op, product(a.above, without(below, a.below)), product(b.above, without(below, b.below))),
            below, both(a.poles, b.poles)};
  }

  // Of `old`, which is `as_it_is` in the new graph.
  Quotient quotient(const Node& old, Expr as_it_is) const {
    Quotient whole{as_it_is, {}};
    const auto none_below = [&] {
      return std::ranges::all_of(old.args, [&](Id id) { return quotients_[id.index].below.empty(); });
    };
    switch (old.op) {
      case Op::add:
      case Op::sub: return none_below() ? whole : sum(operand(old, 0), operand(old, 1), old.op);
      case Op::mul: {
        const Quotient &a = operand(old, 0), &b = operand(old, 1);
        return none_below() ? whole
                            : Quotient{a.above * b.above, product(a.below, b.below), both(a.poles, b.poles)};
      }
      case Op::neg: {
        const Quotient& a = operand(old, 0);
        return none_below() ? whole : Quotient{-a.above, a.below, a.poles};
      }
      case Op::div: {
        const Quotient& a = operand(old, 0);
        if (changes_sign(old.args[1])) return over(a, operand(old, 1));
        return a.below.empty() ? whole : Quotient{a.above / plain(old, 1), a.below, a.poles};
      }
      case Op::powi: {
        const Quotient& a = operand(old, 0);
        const double exponent = *old_.graph.number(old.args[1]);
        const bool inverse = exponent < 0, odd = std::fmod(exponent, 2) != 0;
        if (exponent == 0 || std::abs(exponent) > most_factors) return whole;
        if (inverse ? !odd || !changes_sign(old.args[0]) : none_below()) return whole;
        const auto power = static_cast<unsigned>(std::abs(exponent));
        const Quotient raised{to_power(a.above, power), times(a.below, power), a.poles};
        return inverse ? over({one(as_it_is), {}}, raised) : raised;
      }
      case Op::tan:
        if (!varies(old.args[0])) return whole;
        return over({make(Op::sin, plain(old, 0)), {}}, {make(Op::cos, plain(old, 0)), {}});
      default: return whole;
    }
  }

  const Program& old_;
  std::vector<bool> live_;
  std::vector<std::optional<Range>> known_;
  Graph* graph_ = nullptr;
  std::vector<bool> varies_;  // with x, y or z
  std::vector<Id> plain_;     // the nodes as they were
  std::vector<Quotient> quotients_;
};

}  // namespace

Fraction fraction(const Program& f) { return Fractions(f)(); }

}  // namespace imp
