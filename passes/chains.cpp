#include "passes/chains.h"

#include <algorithm>

#include "passes/rewrite.h"

namespace imp {

Chains::Chains(const Program& program)
    : graph_(program.graph),
      regions_(regions(program)),
      users_(program.graph.size()),
      part_(program.graph.size()) {
  std::vector<Id> user(graph_.size());
  for (const Use& use : uses(program)) {
    ++users_[use.used.index];
    user[use.used.index] = use.user;
  }
  for (std::uint32_t i = static_cast<std::uint32_t>(graph_.size()); i-- > 0;) {
    const Id id{i}, by = user[i];
    if (users_[i] != 1 || !by.valid() || kind(id) == Kind::none || kind(id) != kind(by)) continue;
    part_[i] = graph_[by].op != Op::neg || is_part(by);  // a sign around a whole sum is none of its parts
  }
}

Chains::Kind Chains::kind(Id id) const {
  const Node node = graph_[id];
  if (regions_[id.index] == Region::constant()) return Kind::none;
  switch (node.op) {
    case Op::add:
    case Op::sub:
    case Op::neg: return Kind::sum;
    case Op::mul: return node.args[0] == node.args[1] ? Kind::none : Kind::product;
    default:      return Kind::none;
  }
}

bool Chains::is_sum(Id id) const { return kind(id) == Kind::sum && graph_[id].op != Op::neg && !is_part(id); }

bool Chains::is_product(Id id) const { return kind(id) == Kind::product && !is_part(id); }

std::vector<Operand> Chains::operands(Id chain) const {
  std::vector<Operand> result, open{{chain}};
  while (!open.empty()) {
    const Operand next = open.back();
    open.pop_back();
    if (next.id != chain && !is_part(next.id)) {
      result.push_back(next);
      continue;
    }
    const Node node = graph_[next.id];
    const bool flips = node.op == Op::sub || node.op == Op::neg;
    for (std::size_t i = node.args.size(); i-- > 0;)
      open.push_back({node.args[i], next.negative != (flips && i + 1 == node.args.size())});
  }
  return result;
}

std::vector<Id> Chains::parts(Id chain) const {
  std::vector<Id> result{chain};
  for (std::size_t i = 0; i < result.size(); ++i)
    for (const Id arg : graph_[result[i]].args)
      if (is_part(arg)) result.push_back(arg);
  std::ranges::sort(result);
  return result;
}

Signed operator+(const Signed& a, const Signed& b) {
  if (a.negative == b.negative) return {a.value + b.value, a.negative};
  return {a.negative ? b.value - a.value : a.value - b.value};
}

}  // namespace imp
