#include "passes/extend/interval.h"

#include <algorithm>

#include "ir/assert.h"
#include "passes/extend/forms.h"
#include "passes/extend/over_box.h"

namespace imp {
namespace {

// So far from overflow that a rounding more or less does not matter.
double safe(Type type) { return type == f32 ? 1e30 : 1e300; }

// `a`, of which no value is negative. Its lower end may be, as rounding is not monotone: over the whole domain
// exp(x) - 1 is bounded by constants, within it by a computed exponential. The upper end is not, being at or
// above the exact one.
Interval nonnegative(Interval a) {
  a.nlo = min(zero(a.nlo), a.nlo);
  a.facts.nonnegative = true;
  return a;
}

// For every node whether the rule of a user takes fewer ops where the node is known to be nonnegative.
std::vector<bool> better_nonnegative(const Program& f) {
  std::vector<bool> result(f.graph.size());
  for (std::uint32_t i = 0; i < f.graph.size(); ++i) {
    const Node node = f.graph[Id{i}];
    const auto is_constant = [&](Id arg) { return f.graph[arg].op == Op::constant; };
    switch (node.op) {
      case Op::mul:
        if (std::ranges::any_of(node.args, is_constant)) break;
        [[fallthrough]];
      case Op::fma:  result[node.args[1].index] = true; [[fallthrough]];
      case Op::abs:
      case Op::sqrt:
      case Op::powi:
      case Op::pow:  result[node.args[0].index] = true; break;
      case Op::div:  result[node.args[1].index] = true; break;
      default:       break;
    }
  }
  return result;
}

struct OverBox : IntervalRules {
  const Program& f;
  std::span<const Interval> sides;
  std::vector<std::optional<Range>> known;  // by node, where the domain is
  std::vector<bool> worth_a_sign = better_nonnegative(f);
  Graph& graph;
  Type type;

  OverBox(const Program& program, std::span<const Interval> inputs, std::vector<std::optional<Range>> ranges)
      : f(program),
        sides(inputs),
        known(std::move(ranges)),
        graph(*inputs[0].hi.graph),
        type(inputs[0].hi.type()) {
    IMP_ASSERT(sides.size() == f.inputs.size(), "an enclosure of every input");
  }

  Interval input(std::size_t i) const { return sides[i]; }
  Possible truth(bool value) const { return {truth_of(graph, value), truth_of(graph, !value)}; }
  Interval constant(const Enclosure& value) const { return constant_interval(graph, type, value); }
  Value finished(Id id, Value value) const {
    if (const auto& range = known.empty() ? std::nullopt : known[id.index]) {
      Interval& number = value.number;
      number.facts.bounded |= range->bounded_by(safe(type));
      if (!number.facts.nonnegative && worth_a_sign[id.index] && 0 <= range->lo && range->lo <= range->hi)
        number = nonnegative(number);
    }
    graph.set_span(value.number.hi.id, f.graph.span(id));
    return value;
  }
};

}  // namespace

Interval constant_interval(Graph& graph, Type type, const Enclosure& value) {
  if (value.lo > value.hi) {
    const Expr none{&graph, graph.constant(type, 0)};
    return {none, none, truth_of(graph, true), truth_of(graph, false), {}};
  }
  Interval result = interval(rounded_up(graph, type, -value.lo), rounded_up(graph, type, value.hi),
                             {value.lo >= 0, value.lo > -1e30 && value.hi < 1e30});
  result.continuous = truth_of(graph, value.continuous);
  return result;
}

std::vector<std::optional<Range>> ranges(const Program& program, std::span<const Range> inputs, Type type) {
  Graph scratch;
  std::vector<Interval> boxes;
  for (const Range& range : inputs)
    boxes.push_back(interval(rounded_up(scratch, type, -range.lo), rounded_up(scratch, type, range.hi),
                             {range.lo >= 0, range.bounded_by(safe(type))}));
  const auto values = over_box(program, OverBox(program, boxes, {}));

  std::vector<std::optional<Range>> result(values.size());
  for (std::uint32_t i = 0; i < values.size(); ++i) {
    if (!values[i] || !program.graph[Id{i}].type.is_real()) continue;
    const Interval& number = values[i]->number;
    const auto nlo = scratch.number(number.nlo.id), hi = scratch.number(number.hi.id);
    IMP_ASSERT(nlo && hi, "bounds that fold at a constant box");
    const bool empty = scratch.truth_value(number.empty.id).value_or(false);
    result[i] = empty ? Range{everything.hi, everything.lo} : Range{-*nlo, *hi};
  }
  return result;
}

std::vector<std::optional<IntervalRules::Value>> enclose_nodes(const Program& f,
                                                               std::span<const Interval> inputs,
                                                               std::span<const Range> domain) {
  std::vector<std::optional<Range>> known;
  if (!domain.empty()) known = ranges(f, domain, inputs[0].hi.type());
  return over_box(f, OverBox(f, inputs, std::move(known)));
}

std::optional<std::vector<Interval>> enclose(const Program& f, std::span<const Interval> inputs,
                                             Diagnostics& diagnostics, std::span<const Range> domain) {
  const auto values = outputs_of(f, enclose_nodes(f, inputs, domain), diagnostics);
  if (!values) return std::nullopt;
  return std::vector<Interval>(values->begin(), values->end());
}

std::optional<std::vector<Interval>> interval_form(const Program& f, const InputBox& box,
                                                   Diagnostics& diagnostics) {
  return enclose(f, box.sides, diagnostics, box.domain);
}

}  // namespace imp
