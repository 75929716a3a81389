// The slope form: f(c) + S (X - c), where the slope S encloses (f(x) - f(c)) / (x - c) for every x of the
// box. Each op has a rule for slopes (Krawczyk and Neumaier 1985; Ratz 1996); for most functions it is the
// chain rule with the derivative over the range. Unlike derivatives, slopes go around corners.
#include <algorithm>
#include <cmath>

#include "ir/replay.h"
#include "passes/extend/centred.h"
#include "passes/extend/forms.h"
#include "passes/extend/interval.h"
#include "passes/extend/partial_derivatives.h"

namespace imp {
namespace {

using Partial = std::optional<Interval>;  // of one variable; nothing: zero
using Slope = std::vector<Partial>;

// A node in the middle of the box, over all of it, and its slope, which `holds` there.
struct Sloped {
  IntervalRules::Value at, over;
  Slope slope;
  Truth holds;
};

class SlopeRules {
 public:
  using Value = Sloped;
  SlopeRules(Op op, Sloped node) : op_(op), node_(std::move(node)) {}

  Sloped add(const Sloped& a, const Sloped& b) { return is(joined(a.slope, b.slope), a, b); }
  Sloped sub(const Sloped& a, const Sloped& b) { return is(joined(a.slope, negative(b.slope)), a, b); }
  Sloped neg(const Sloped& a) { return is(negative(a.slope), a, a); }
  Sloped mul(const Sloped& a, const Sloped& b) { return is(product(a, b), a, b); }
  Sloped fma(const Sloped& a, const Sloped& b, const Sloped& c) {
    return is(joined(product(a, b), c.slope), is({}, a, b), c);
  }
  Sloped square(const Sloped& a) { return is(scaled(a.slope, rules_.add(a.at, a.over)), a, a); }
  Sloped div(const Sloped& a, const Sloped& b) {
    const Slope top = joined(a.slope, negative(scaled(b.slope, node_.at)));
    return is(divided(top, b.over), a, b);
  }
  Sloped sqrt(const Sloped& a) { return is(divided(a.slope, rules_.add(node_.at, node_.over)), a, a); }
  Sloped abs(const Sloped& a) { return is(scaled(a.slope, rules_.sign(a.over)), a, a); }
  Sloped min(const Sloped& a, const Sloped& b) {
    return is(chosen(rules_.lt(a.over, b.over), a.slope, b.slope), a, b);
  }
  Sloped max(const Sloped& a, const Sloped& b) {
    return is(chosen(rules_.lt(b.over, a.over), a.slope, b.slope), a, b);
  }
  Sloped select(const Sloped& c, const Sloped& a, const Sloped& b) {
    const Possible truth = c.over;
    Sloped result = is(chosen(truth, a.slope, b.slope), a, b);
    result.holds = result.holds && !(truth.yes && truth.no);
    return result;
  }
  // Where these are continuous they are constant.
  Sloped floor(const Sloped& a) { return is({}, a, a); }
  Sloped ceil(const Sloped& a) { return is({}, a, a); }
  Sloped sign(const Sloped& a) { return is({}, a, a); }
  Sloped mod(const Sloped& a, const Sloped& b) {
    const Interval turns = rules_.floor(rules_.div(a.over, b.over));
    return is(joined(a.slope, negative(scaled(b.slope, turns))), a, b);
  }
  Sloped powi(const Sloped& a, const Sloped& exponent) {
    const Interval& n = exponent.over;
    const double value = n.hi.graph->number(n.hi.id).value_or(0);
    const auto degree = static_cast<unsigned>(std::abs(value));
    if (degree == 0) return is({}, a, a);
    Interval factor = quotient(a, degree);
    if (value < 0)
      factor = rules_.neg(rules_.div(factor, rules_.mul(power(a.at, degree), power(a.over, degree))));
    return is(scaled(a.slope, factor), a, a);
  }

  // Of any other op: the mean value theorem over the ranges of its operands.
  std::optional<Sloped> by_derivatives(std::span<const Sloped> args) {
    std::vector<Interval> operands;
    for (const Sloped& arg : args) operands.push_back(arg.over);
    const auto derivatives = partial_derivatives(op_, operands);
    if (!derivatives) return std::nullopt;
    Slope slope;
    Truth holds = node_.holds;
    for (std::size_t i = 0; i < args.size(); ++i) {
      if (args[i].slope.empty()) continue;
      slope = joined(slope, scaled(args[i].slope, (*derivatives)[i]));
      holds = holds && args[i].holds && !(*derivatives)[i].empty;
    }
    return Sloped{node_.at, node_.over, slope, holds};
  }

 private:
  Sloped is(const Slope& slope, const Sloped& a, const Sloped& b) {
    Truth holds = a.holds && b.holds;
    for (const Partial& partial : slope)
      if (partial) holds = holds && !partial->empty;
    return {node_.at, node_.over, slope, holds};
  }

  Interval unit() const { return point(one(node_.over.number.hi), {true, true}); }

  // (u^n - c^n) / (u - c), for u in the range and c in the middle.
  Interval quotient(const Sloped& a, unsigned n) {
    if (n == 1) return unit();
    const Interval half = quotient(a, n / 2);
    const Interval even = rules_.mul(half, rules_.add(power(a.at, n / 2), power(a.over, n / 2)));
    return n % 2 == 0 ? even : rules_.add(rules_.mul(even, a.over), power(a.at, n - 1));
  }
  Interval power(const Interval& a, unsigned n) {
    return n == 1 ? a : rules_.powi(a, point(constant_like(a.hi, n)));
  }

  Slope negative(Slope a) {
    for (Partial& partial : a)
      if (partial) partial = rules_.neg(*partial);
    return a;
  }
  Slope scaled(Slope a, const Interval& factor) {
    for (Partial& partial : a)
      if (partial) partial = rules_.mul(*partial, factor);
    return a;
  }
  Slope divided(Slope a, const Interval& divisor) {
    for (Partial& partial : a)
      if (partial) partial = rules_.div(*partial, divisor);
    return a;
  }
  Slope joined(const Slope& a, const Slope& b) {
    Slope result = a.empty() ? Slope(b.size()) : a;
    for (std::size_t i = 0; i < b.size(); ++i)
      if (b[i]) result[i] = result[i] ? rules_.add(*result[i], *b[i]) : b[i];
    return result;
  }
  // u v - u(c) v(c) = (u - u(c)) v + u(c) (v - v(c))
  Slope product(const Sloped& a, const Sloped& b) {
    return joined(scaled(a.slope, b.over), scaled(b.slope, a.at));
  }
  Slope chosen(const Possible& c, const Slope& a, const Slope& b) {
    Slope result(std::max(a.size(), b.size()));
    const Interval none = point(zero(node_.over.number.hi), {true, true});
    const auto part = [&](const Slope& slope, std::size_t i) {
      return i < slope.size() && slope[i] ? *slope[i] : none;
    };
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = rules_.select(c, part(a, i), part(b, i));
    return result;
  }

  IntervalRules rules_;
  Op op_;
  Sloped node_;
};

}  // namespace

std::optional<std::vector<Interval>> slope_form(const Program& f, const InputBox& box,
                                                Diagnostics& diagnostics) {
  const auto all = interval_form(f, box, diagnostics);
  if (!all) return std::nullopt;
  const Centre centre = centre_of(box);
  const auto over = enclose_nodes(f, box.sides, box.domain);
  const auto at = enclose_nodes(f, centre.sides, box.domain);
  const std::size_t n = box.variables.size();
  const Truth always = truth_of(*box.sides[0].hi.graph, true);

  std::vector<std::optional<Sloped>> nodes(f.graph.size());
  std::vector<Sloped> args;
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    if (!over[i] || !at[i]) continue;
    Sloped node{*at[i], *over[i], {}, always};
    const Node& source = f.graph[Id{i}];
    args.clear();
    bool flat = true;
    for (const Id arg : source.args)
      if (nodes[arg.index]) {
        args.push_back(*nodes[arg.index]);
        flat = flat && args.back().slope.empty();
      }
    if (args.size() < source.args.size()) continue;
    if (source.op == Op::input) {
      const auto variable = std::ranges::find(box.variables, source.payload);
      if (variable != box.variables.end()) {
        node.slope.resize(n);
        node.slope[static_cast<std::size_t>(variable - box.variables.begin())] =
            point(one(box.sides[0].hi), {true, true});
      }
      nodes[i] = node;
    } else if (flat || source.type.is_truth()) {
      nodes[i] = node;
    } else {
      SlopeRules rules(source.op, node);
      if (source.op == Op::mul && source.args[0] == source.args[1])
        nodes[i] = rules.square(args[0]);
      else if (auto known = apply(rules, source.op, std::span<const Sloped>(args)))
        nodes[i] = known;
      else
        nodes[i] = rules.by_derivatives(args);
    }
  }

  const IntervalRules rules;
  std::vector<Interval> result;
  for (std::size_t i = 0; i < f.outputs.size(); ++i) {
    const auto& node = nodes[f.outputs[i].id.index];
    if (!node) {
      diagnostics.error(f.graph.span(f.outputs[i].id), "the slope form cannot bound this");
      return std::nullopt;
    }
    Interval value = node->at;
    for (std::size_t k = 0; k < node->slope.size(); ++k)
      if (node->slope[k])
        value = rules.add(value, symmetric(rules.mul(magnitude_of(*node->slope[k]), centre.radius[k]).hi));
    result.push_back(or_intervals((*all)[i], node->holds, value));
  }
  return result;
}

}  // namespace imp
