// How far rounding may move a value: the formula evaluated on magnitudes beside the value. A value
// computed in doubles is off by no more than a few ulp of its scale.
#pragma once

#include <cmath>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "ir/meaning.h"
#include "ir/program.h"
#include "ir/replay.h"

namespace imp::test {

struct Scaled {
  double value = 0;  // truths: 0 or 1
  double scale = 0;  // at least |value|
};

// |a| + |b| for a ± b, |a| |b| for a b, and so on: scales in the place of magnitudes.
struct ScaleRules {
  using Value = Scaled;

  Scaled add(Scaled a, Scaled b) { return {a.value + b.value, a.scale + b.scale}; }
  Scaled sub(Scaled a, Scaled b) { return {a.value - b.value, a.scale + b.scale}; }
  Scaled mul(Scaled a, Scaled b) { return {a.value * b.value, a.scale * b.scale}; }
  Scaled div(Scaled a, Scaled b) {
    return {a.value / b.value, a.scale / std::abs(b.value) * (b.scale / std::abs(b.value))};
  }
  Scaled fma(Scaled a, Scaled b, Scaled c) { return add(mul(a, b), c); }
  Scaled neg(Scaled a) { return {-a.value, a.scale}; }
  Scaled abs(Scaled a) { return {std::abs(a.value), a.scale}; }
  Scaled min(Scaled a, Scaled b) { return a.value < b.value ? a : b; }
  Scaled max(Scaled a, Scaled b) { return a.value > b.value ? a : b; }
  Scaled powi(Scaled a, Scaled n) {
    return {meaning::powi(a.value, n.value),
            n.value < 0 ? std::pow(a.scale / (a.value * a.value), -n.value) : std::pow(a.scale, n.value)};
  }
  Scaled chebyshev(Scaled a, Scaled n, Scaled k) {
    const double outside = std::fmax(1, std::abs(a.value));
    const auto at = [&](double x, double order) { return meaning::chebyshev(x, n.value, order); };
    const double slope = k.value < n.value ? at(outside, k.value + 1) : 0;
    return {at(a.value, k.value), n.value * n.value * at(outside, k.value) + slope * a.scale};
  }
  Scaled sqrt(Scaled a) {
    const double root = std::sqrt(a.value);
    return {root, root > 0 ? a.scale / root : std::sqrt(a.scale)};
  }
  Scaled select(Scaled c, Scaled a, Scaled b) { return c.value != 0 ? a : b; }
  Scaled lt(Scaled a, Scaled b) { return {a.value < b.value ? 1.0 : 0.0, 0}; }
  Scaled le(Scaled a, Scaled b) { return {a.value <= b.value ? 1.0 : 0.0, 0}; }
  Scaled eq(Scaled a, Scaled b) { return {a.value == b.value ? 1.0 : 0.0, 0}; }
  Scaled and_(Scaled a, Scaled b) { return {a.value * b.value, 0}; }
  Scaled or_(Scaled a, Scaled b) { return {std::fmax(a.value, b.value), 0}; }
  Scaled not_(Scaled a) { return {1 - a.value, 0}; }
};

// The scale of every output; throws std::runtime_error on an op without a rule. Numbers are f64.
inline std::vector<double> error_scales(const Program& program, std::span<const double> inputs) {
  ScaleRules rules;
  std::vector<Scaled> values;
  for (std::uint32_t i = 0; i < program.graph.size(); ++i) {
    const Node node = program.graph[Id{i}];
    if (node.op == Op::input) {
      values.push_back({inputs[node.payload], std::abs(inputs[node.payload])});
    } else if (node.op == Op::constant) {
      const double value = program.graph.number(Id{i}).value_or(static_cast<double>(node.payload));
      values.push_back({value, std::abs(value)});
    } else {
      std::vector<Scaled> args;
      for (const Id arg : node.args) args.push_back(values[arg.index]);
      const auto value = apply(rules, node.op, args);
      if (!value) throw std::runtime_error("no error scale for " + std::string(info(node.op).name));
      values.push_back(*value);
    }
  }
  std::vector<double> scales;
  for (const Output& output : program.outputs) scales.push_back(values[output.id.index].scale);
  return scales;
}

}  // namespace imp::test
