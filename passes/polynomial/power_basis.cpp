#include "passes/polynomial/power_basis.h"

#include "ir/assert.h"
#include "ir/replay.h"
#include "passes/chebyshev.h"
#include "passes/extend/interval.h"
#include "passes/polynomial/degree.h"

namespace imp {
namespace {

constexpr std::uint32_t highest_power = 32;
constexpr double most_coefficients = 500;  // three variables of degree 12

double coefficients(std::uint32_t degree, std::size_t variables) {
  double count = 1;
  for (std::size_t i = 1; i <= variables; ++i)
    count = count * (degree + static_cast<double>(i)) / static_cast<double>(i);
  return count;
}

bool is_small(const Program& f, std::span<const Degree> degrees, std::size_t variables,
              Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < degrees.size(); ++i) {
    const std::uint32_t n = degrees[i].total;
    if (n <= highest_power && coefficients(n, variables) <= most_coefficients) continue;
    diagnostics.error(f.graph.span(f.outputs[i].id),
                      "this polynomial of degree " + std::to_string(n) + " has too many coefficients");
    return false;
  }
  return true;
}

// For each node in which there is no variable, and that stands beside one or is an output, its enclosure.
// A truth is 1 where it may hold, 0 where it may fail.
std::optional<std::vector<std::optional<Interval>>> constants(const Program& f, const InputBox& box,
                                                              const std::vector<bool>& depends,
                                                              Diagnostics& diagnostics) {
  Program part{.name = f.name, .graph = f.graph, .inputs = f.inputs};
  std::vector<bool> wanted(depends.size());
  for (std::uint32_t i = 0; i < depends.size(); ++i)
    if (depends[i])
      for (const Id arg : f.graph[Id{i}].args) wanted[arg.index] = !depends[arg.index];
  for (const Output& output : f.outputs) wanted[output.id.index] = !depends[output.id.index];

  for (std::uint32_t i = 0; i < wanted.size(); ++i) {
    if (!wanted[i]) continue;
    Id id{i};
    if (f.graph[id].type.is_truth())
      id = part.graph.add(Op::select, {id, part.graph.constant(f64, 1), part.graph.constant(f64, 0)});
    part.outputs.push_back({"", id});
  }
  const auto values = enclose(compact(part), box.sides, diagnostics, box.domain);
  if (!values) return std::nullopt;
  std::vector<std::optional<Interval>> result(wanted.size());
  for (std::size_t i = 0, k = 0; i < wanted.size(); ++i)
    if (wanted[i]) result[i] = (*values)[k++];
  return result;
}

}  // namespace

std::optional<std::vector<Polynomial>> power_basis(const Program& program, const InputBox& box,
                                                   const Substitution& substitution,
                                                   Diagnostics& diagnostics) {
  const auto& places = substitution.places;
  const Program f = compact(reduce_chebyshev(program));
  IMP_ASSERT(places.size() == box.variables.size(), "a place for each variable");
  const auto found = degrees(f, box.variables, diagnostics);
  if (!found || !is_small(f, *found, places.size(), diagnostics)) return std::nullopt;
  const auto depends = depends_on(f, box.variables);
  const auto known = constants(f, box, depends, diagnostics);
  if (!known) return std::nullopt;

  PolynomialRules rules(box.sides[0].hi, substitution.unit);
  std::vector<Polynomial> values(f.graph.size()), args;
  for (std::size_t i = 0; i < places.size(); ++i) values[f.inputs[box.variables[i]].id.index] = places[i];
  for (std::uint32_t i = 0; i < values.size(); ++i) {
    const Node node = f.graph[Id{i}];
    if (const auto& constant = (*known)[i]) values[i] = polynomial(*constant);
    if (!depends[i] || node.op == Op::input) continue;
    args.clear();
    for (const Id arg : node.args) args.push_back(values[arg.index]);
    if (node.op == Op::powi)
      rules.exponent = static_cast<std::uint32_t>(f.graph.number(node.args[1]).value());
    const bool same = node.op == Op::mul && node.args[0] == node.args[1];
    values[i] = same ? rules.square(args[0]) : *apply(rules, node.op, std::span<const Polynomial>(args));
  }

  std::vector<Polynomial> result;
  for (std::size_t i = 0; i < f.outputs.size(); ++i)
    result.push_back(rules.raised(values[f.outputs[i].id.index], (*found)[i].total));
  return result;
}

std::vector<Interval> in_order(const Polynomial& polynomial, std::uint32_t degree, Expr like) {
  std::vector<Interval> result(degree + 1, point(zero(like), {true, true}));
  for (const auto& [powers, value] : polynomial) result[powers[0]] = value;
  return result;
}

}  // namespace imp
