#include "passes/inline.h"

#include "ir/assert.h"

namespace imp {

std::vector<Expr> inline_program(const Program& program, std::span<const Expr> inputs) {
  IMP_ASSERT(program.phases.empty() && program.callees.empty(), "a straight-line Program");
  IMP_ASSERT(inputs.size() == program.inputs.size() && !inputs.empty(), "a value for every input");
  Graph& graph = *inputs[0].graph;
  std::vector<Id> moved(program.graph.size());
  std::vector<Id> args;
  for (std::uint32_t i = 0; i < moved.size(); ++i) {
    const Node node = program.graph[Id{i}];
    if (node.op == Op::input) {
      moved[i] = inputs[node.payload].id;
      continue;
    }
    args.clear();
    for (const Id arg : node.args) args.push_back(moved[arg.index]);
    moved[i] = rebuild(graph, node, args, node.payload);
    graph.set_span(moved[i], program.graph.span(Id{i}));
    graph.set_name(moved[i], program.graph.name(Id{i}));
  }
  std::vector<Expr> outputs;
  for (const Output& output : program.outputs) outputs.push_back({&graph, moved[output.id.index]});
  return outputs;
}

}  // namespace imp
