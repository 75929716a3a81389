#include "passes/polynomial/degree.h"

#include <algorithm>

#include "ir/assert.h"
#include "ir/replay.h"

namespace imp {
namespace {

std::uint32_t capped(std::uint64_t degree) {
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(degree, std::uint64_t{1} << 30));
}

template <class Join>
Degree joined(Degree a, const Degree& b, Join join) {
  a.total = join(a.total, b.total);
  for (std::size_t i = 0; i < a.in.size(); ++i) a.in[i] = join(a.in[i], b.in[i]);
  return a;
}

// One line for each op of which polynomials are made; every other op makes none.
struct DegreeRules {
  using Value = std::optional<Degree>;  // nothing: no polynomial
  double exponent = 0;                  // of the power or Chebyshev polynomial at hand

  Value add(const Value& a, const Value& b) { return largest(*a, *b); }
  Value sub(const Value& a, const Value& b) { return largest(*a, *b); }
  Value mul(const Value& a, const Value& b) { return sum(*a, *b); }
  Value fma(const Value& a, const Value& b, const Value& c) { return largest(sum(*a, *b), *c); }
  Value neg(const Value& a) { return a; }
  Value div(const Value& a, const Value& b) { return b->total == 0 ? a : Value(); }
  Value powi(const Value& a, const Value&) { return exponent < 0 ? Value() : times(*a, exponent); }
  Value chebyshev(const Value& a, const Value&, const Value&) { return times(*a, exponent); }
  Value select(const Value&, const Value& a, const Value& b) { return largest(*a, *b); }

 private:
  static Degree largest(const Degree& a, const Degree& b) {
    return joined(a, b, [](std::uint32_t p, std::uint32_t q) { return std::max(p, q); });
  }
  static Degree sum(const Degree& a, const Degree& b) {
    return joined(a, b, [](std::uint64_t p, std::uint64_t q) { return capped(p + q); });
  }
  static Degree times(const Degree& a, double n) {
    const auto factor = static_cast<std::uint64_t>(n);
    return joined(a, a, [=](std::uint64_t p, std::uint64_t) { return capped(p * factor); });
  }
};

struct Found {
  std::optional<Degree> degree;
  Id culprit;  // which made it no polynomial
};

}  // namespace

std::vector<bool> depends_on(const Program& f, std::span<const std::size_t> variables) {
  std::vector<bool> depends(f.graph.size());
  for (const std::size_t i : variables) depends[f.inputs[i].id.index] = true;
  for (std::uint32_t i = 0; i < depends.size(); ++i)
    for (const Id arg : f.graph[Id{i}].args) depends[i] = depends[i] || depends[arg.index];
  return depends;
}

std::string names_of(const Program& f, std::span<const std::size_t> variables) {
  std::string names;
  for (const std::size_t i : variables) names += (names.empty() ? "" : ", ") + f.inputs[i].name;
  return names;
}

std::optional<std::vector<Degree>> degrees(const Program& f, std::span<const std::size_t> variables,
                                           Diagnostics& diagnostics) {
  IMP_ASSERT(f.phases.empty() && f.callees.empty(), "a formula");
  const std::vector<bool> depends = depends_on(f, variables);
  const Degree constant{0, std::vector<std::uint32_t>(variables.size())};
  std::vector<Found> found(f.graph.size(), {constant, {}});
  for (std::size_t i = 0; i < variables.size(); ++i) {
    Degree& linear = *found[f.inputs[variables[i]].id.index].degree;
    linear.total = linear.in[i] = 1;
  }

  std::vector<std::optional<Degree>> args;
  for (std::uint32_t i = 0; i < found.size(); ++i) {
    const Node node = f.graph[Id{i}];
    if (!depends[i] || node.op == Op::input) continue;
    args.clear();
    for (const Id arg : node.args) {
      if (!found[arg.index].degree) found[i] = found[arg.index];
      args.push_back(found[arg.index].degree);
    }
    if (!found[i].degree) continue;
    DegreeRules rules;
    if (node.op == Op::powi) rules.exponent = f.graph.number(node.args[1]).value();
    if (node.op == Op::chebyshev)
      rules.exponent = f.graph.number(node.args[1]).value() - f.graph.number(node.args[2]).value();
    found[i] = {apply(rules, node.op, std::span<const DegreeRules::Value>(args)).value_or(std::nullopt),
                Id{i}};
  }

  std::vector<Degree> result;
  for (const Output& output : f.outputs) {
    const Found& of_output = found[output.id.index];
    if (!of_output.degree) {
      diagnostics.error(f.graph.span(of_output.culprit),
                        "'" + std::string(info(f.graph[of_output.culprit].op).name) +
                            "' makes this no polynomial in " + names_of(f, variables));
      return std::nullopt;
    }
    result.push_back(*of_output.degree);
  }
  return result;
}

}  // namespace imp
