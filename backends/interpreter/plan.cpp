#include "backends/interpreter/plan.h"

#include <map>

namespace imp {

Plan::Plan(const Program& run) : program(run), schedule(imp::schedule(run)), start(run.graph.size()) {
  for (const auto& callee : program.callees) callees.push_back(std::make_unique<Plan>(*callee));

  for (std::uint32_t i = 0; i < start.size(); ++i) {
    const Node node = program.graph[Id{i}];
    if (node.op == Op::constant) start[i] = node.payload;
    if (!node.type.is_table()) continue;
    start[i] = table_elements;
    table_elements += node.type.length;
  }

  std::map<std::pair<std::uint32_t, std::vector<Id>>, Id> firsts;
  for (auto& nodes : schedule)
    std::erase_if(nodes, [&](Id id) {
      const Node node = program.graph[id];
      if (node.op != Op::call) return false;
      const auto [it, is_first] = firsts.try_emplace({node.high(), {node.args.begin(), node.args.end()}}, id);
      calls[it->second].push_back(id);
      return !is_first;
    });
}

}  // namespace imp
