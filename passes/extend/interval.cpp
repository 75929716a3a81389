#include "passes/extend/interval.h"

#include <limits>

#include "ir/assert.h"
#include "passes/constants.h"

namespace imp {
namespace {

using Value = IntervalRules::Value;

constexpr double infinity = std::numeric_limits<double>::infinity();

// So far from overflow that a rounding more or less does not matter.
double safe(Type type) { return type == f32 ? 1e30 : 1e300; }

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

// Runs the rules over every node of `f`. Where an op has no rule, `refuse` is told of the node.
template <class Refuse>
std::vector<std::optional<Value>> replay_intervals(const Program& f, std::span<const Interval> inputs,
                                                   std::span<const std::optional<Range>> known,
                                                   Refuse refuse) {
  IMP_ASSERT(inputs.size() == f.inputs.size() && !inputs.empty(), "an enclosure of every input");
  Graph& graph = *inputs[0].hi.graph;
  const Type type = inputs[0].hi.type();
  const auto constants = constant_values(f);
  IntervalRules rules;
  std::vector<std::optional<Value>> values(f.graph.size());
  std::vector<Value> args;

  for (std::uint32_t i = 0; i < values.size(); ++i) {
    const Node node = f.graph[Id{i}];
    if (node.op == Op::input) {
      values[i] = inputs[node.payload];
    } else if (node.type.is_truth() && node.op == Op::constant) {
      const Truth value = truth_of(graph, node.payload != 0);
      values[i] = Possible{value, !value};
    } else if (constants[i] && node.type.is_real()) {
      values[i] = constant_interval(graph, type, *constants[i]);
    } else {
      args.clear();
      for (const Id arg : node.args)
        if (values[arg.index]) args.push_back(*values[arg.index]);
      if (args.size() < node.args.size()) {
        // an operand was refused
      } else if (node.op == Op::mul && node.args[0] == node.args[1]) {
        values[i] = rules.square(args[0]);
      } else {
        values[i] = apply(rules, node.op, std::span<const Value>(args));
      }
      if (!values[i]) refuse(Id{i});
    }
    if (values[i] && node.type.is_real()) {
      Interval& number = values[i]->number;
      if (!known.empty() && known[i]) number.facts.bounded |= known[i]->bounded_by(safe(type));
      graph.set_span(number.hi.id, f.graph.span(Id{i}));
    }
  }
  return values;
}

}  // namespace

std::vector<std::optional<Range>> ranges(const Program& program, std::span<const Range> inputs, Type type) {
  Graph scratch;
  std::vector<Interval> boxes;
  for (const Range& range : inputs)
    boxes.push_back(interval(rounded_up(scratch, type, -range.lo), rounded_up(scratch, type, range.hi),
                             {range.lo >= 0, range.bounded_by(safe(type))}));
  const auto values = replay_intervals(program, boxes, {}, [](Id) {});

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

std::optional<std::vector<Interval>> enclose(const Program& f, std::span<const Interval> inputs,
                                             Diagnostics& diagnostics, std::span<const Range> domain) {
  std::vector<std::optional<Range>> known;
  if (!domain.empty()) known = ranges(f, domain, inputs[0].hi.type());
  std::optional<Id> refused;
  const auto values = replay_intervals(f, inputs, known, [&](Id id) {
    if (!refused) refused = id;
  });

  std::vector<Interval> result;
  for (const Output& output : f.outputs) {
    if (!values[output.id.index]) {
      diagnostics.error(f.graph.span(*refused), "the interval extension cannot bound '" +
                                                    std::string(info(f.graph[*refused].op).name) + "' yet");
      return std::nullopt;
    }
    result.push_back(*values[output.id.index]);
  }
  return result;
}

std::optional<Program> interval_extension(const Program& f, Type type, Diagnostics& diagnostics) {
  Program result{.name = f.name};
  Graph& graph = result.graph;
  std::vector<Interval> boxes;
  Truth no_box = truth_of(graph, false);
  for (const Input& input : f.inputs) {
    const Expr lo{&graph, add_input(result, input.name + "lo", f64, input.rate)};
    const Expr hi{&graph, add_input(result, input.name + "hi", f64, input.rate)};
    no_box = no_box || !(lo <= hi) || !(lo < infinity) || !(-infinity < hi);
    boxes.push_back(type == f32 ? interval(narrow_up(-lo), narrow_up(hi)) : interval(-lo, hi));
  }
  const auto values = enclose(f, boxes, diagnostics);
  if (!values) return std::nullopt;

  for (std::size_t i = 0; i < values->size(); ++i) {
    const Interval& value = (*values)[i];
    const std::string& name = f.outputs[i].name;
    const Truth empty = value.empty || no_box;
    const auto wide = [&](Expr end) { return type == f32 ? widen(end) : end; };
    const Expr lo = wide(value.lo()), hi = wide(value.hi);
    const Expr infinite = constant_like(hi, infinity);
    result.outputs.push_back({name + "lo", select(empty, infinite, lo).id});
    result.outputs.push_back({name + "hi", select(empty, -infinite, hi).id});
    result.outputs.push_back({name + "defined", (value.continuous && !empty).id});
  }
  return result;
}

}  // namespace imp
