#include "ir/regions.h"

#include <algorithm>

namespace imp {

std::vector<Region> regions(const Program& program) {
  std::vector<Region> of(program.graph.size());
  for (std::uint32_t i = 0; i < of.size(); ++i) {
    const Node node = program.graph[Id{i}];
    switch (node.op) {
      case Op::input:  of[i] = Region::of(program.inputs[node.payload].rate); break;
      case Op::state:  of[i] = Region::in_phase(node.high()); break;
      case Op::result: of[i] = Region::after_phase(node.high()); break;
      default:
        for (const Id arg : node.args) of[i] = std::max(of[i], of[arg.index]);
    }
  }
  return of;
}

std::vector<std::vector<Id>> schedule(const Program& program) {
  std::vector<bool> needed(program.graph.size());
  const auto need = [&](Id id) {
    if (id.valid()) needed[id.index] = true;
  };
  for (const Output& output : program.outputs) need(output.id);
  for (const Phase& phase : program.phases) {
    need(phase.enter);
    need(phase.again);
    for (const State& state : phase.states) need(state.init), need(state.next);
  }
  for (std::size_t i = needed.size(); i-- > 0;)
    if (needed[i])
      for (const Id arg : program.graph[Id{static_cast<std::uint32_t>(i)}].args) need(arg);

  const auto region = regions(program);
  std::vector<std::vector<Id>> result(Region::after_phase(program.phases.size()).rank);
  for (std::uint32_t i = 0; i < needed.size(); ++i) {
    const Op op = program.graph[Id{i}].op;
    const bool leaf = op == Op::constant || op == Op::input || op == Op::state || op == Op::result;
    if (needed[i] && !leaf) result[region[i].rank].push_back(Id{i});
  }
  return result;
}

}  // namespace imp
