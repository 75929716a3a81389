// Rebuilding a Program node by node.
#include "passes/rewrite.h"

#include "ir/assert.h"

namespace imp {
namespace {

// Calls `visit(id)` for every place outside the graph that holds a node. Works on a Program that is
// const and on one that is not: `visit` may then replace the id.
template <class P, class Visit>
void for_each_root(P& program, Visit visit) {
  for (auto& input : program.inputs) visit(input.id);
  for (auto& phase : program.phases) {
    for (auto& state : phase.states) {
      visit(state.id);
      visit(state.result);
      visit(state.init);
      visit(state.next);
    }
    visit(phase.enter);
    visit(phase.again);
  }
  for (auto& output : program.outputs) visit(output.id);
}

bool is_leaf(Op op) { return op == Op::input || op == Op::state || op == Op::result; }

}  // namespace

std::vector<bool> live_nodes(const Program& program) {
  const Graph& graph = program.graph;
  std::vector<bool> live(graph.size());
  for_each_root(program, [&](Id id) {
    if (id.valid()) live[id.index] = true;
  });
  for (std::uint32_t i = static_cast<std::uint32_t>(graph.size()); i-- > 0;)
    if (live[i])
      for (Id arg : graph[Id{i}].args) live[arg.index] = true;
  return live;
}

std::vector<Use> uses(const Program& program) {
  std::vector<Use> result;
  for_each_root(program, [&](Id id) {
    if (id.valid()) result.push_back({id, {}});
  });
  const std::vector<bool> live = live_nodes(program);
  for (std::uint32_t i = 0; i < live.size(); ++i)
    if (live[i])
      for (const Id arg : program.graph[Id{i}].args) result.push_back({arg, Id{i}});
  return result;
}

Program rewrite(const Program& program, const Rule& rule, const Retype& retype) {
  Program result{program.name, {}, program.inputs, program.phases, program.outputs, program.callees};
  for (Input& input : result.inputs) input.type = retype(input.type);
  for (Phase& phase : result.phases)
    for (State& state : phase.states) state.type = retype(state.type);

  const std::vector<bool> live = live_nodes(program);
  std::vector<Id> now(program.graph.size());
  std::vector<Id> args;
  for (std::uint32_t i = 0; i < now.size(); ++i) {
    if (!live[i]) continue;
    const Id old{i};
    Node node = program.graph[old];
    args.clear();
    for (Id arg : node.args) args.push_back(now[arg.index]);
    node.args = args;
    node.type = retype(node.type);
    now[i] = rule(result.graph, old, node);
    IMP_ASSERT(now[i].valid(), "a node for every node");
    if (is_leaf(result.graph[now[i]].op)) continue;  // which have the name of their input or state
    if (const Span span = program.graph.span(old); span.valid()) result.graph.set_span(now[i], span);
    if (const auto name = program.graph.name(old); !name.empty()) result.graph.set_name(now[i], name);
  }
  for_each_root(result, [&](Id& id) {
    if (id.valid()) id = now[id.index];
  });
  return result;
}

Program rewrite(const Program& program, const Rule& rule) {
  return rewrite(program, rule, [](Type type) { return type; });
}

}  // namespace imp
