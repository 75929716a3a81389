// Runs a Program over a box by the rules of a kind of set: intervals, affine forms.
#pragma once

#include <algorithm>
#include <string>

#include "ir/diagnostics.h"
#include "ir/replay.h"
#include "passes/constants.h"

namespace imp {

// The values of all nodes of `f`, by index; nothing for an op that has no rule, and for what depends on one.
// `rules` has a rule an op, and beside them: square(a); input(index), truth(value) and constant(enclosure), the
// leaves; finished(id, value), what to make of a number that is node `id`.
template <class Rules>
std::vector<std::optional<typename Rules::Value>> over_box(const Program& f, const Rules& rules) {
  using Value = typename Rules::Value;
  const auto constants = constant_values(f);
  std::vector<std::optional<Value>> values(f.graph.size());
  std::vector<Value> args;
  for (std::uint32_t i = 0; i < values.size(); ++i) {
    const Node node = f.graph[Id{i}];
    if (node.op == Op::input) {
      values[i] = rules.input(node.payload);
    } else if (node.type.is_truth() && node.op == Op::constant) {
      values[i] = rules.truth(node.payload != 0);
    } else if (constants[i] && node.type.is_real()) {
      values[i] = rules.constant(*constants[i]);
    } else {
      args.clear();
      for (const Id arg : node.args)
        if (values[arg.index]) args.push_back(*values[arg.index]);
      if (args.size() < node.args.size()) continue;
      values[i] = node.op == Op::mul && node.args[0] == node.args[1]
                      ? Value(rules.square(args[0]))
                      : apply(rules, node.op, std::span<const Value>(args));
    }
    if (values[i] && node.type.is_real()) values[i] = rules.finished(Id{i}, *values[i]);
  }
  return values;
}

// Of the values of all nodes those of the outputs; an error where one has no rule.
template <class Value>
std::optional<std::vector<Value>> outputs_of(const Program& f,
                                             const std::vector<std::optional<Value>>& values,
                                             Diagnostics& diagnostics) {
  std::vector<Value> result;
  for (const Output& output : f.outputs) {
    if (!values[output.id.index]) {
      const auto refused =
          std::ranges::find_if(values, [](const auto& value) { return !value; }) - values.begin();
      const Id id{static_cast<std::uint32_t>(refused)};
      diagnostics.error(f.graph.span(id), "the interval extension cannot bound '" +
                                              std::string(info(f.graph[id].op).name) + "' yet");
      return std::nullopt;
    }
    result.push_back(*values[output.id.index]);
  }
  return result;
}

}  // namespace imp
