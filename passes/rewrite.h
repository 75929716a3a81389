// Rebuilding a Program node by node: what every pass from nodes to nodes is made of. Inputs, phases,
// outputs, callees, spans and names are carried over; a pass is the rule for one node.
#pragma once

#include <functional>

#include "ir/program.h"

namespace imp {

// What stands in the new graph for node `old` of the Program: `node` is that node over its new
// operands and with its new type.
using Rule = std::function<Id(Graph& graph, Id old, const Node& node)>;

// What numbers of this type become.
using Retype = std::function<Type(Type)>;

// The node itself: the rule that changes nothing.
inline Id copy(Graph& graph, const Node& node) { return rebuild(graph, node, node.args, node.payload); }

// `program` by `rule`, without its dead nodes. The span and the name of a node go to its replacement.
Program rewrite(const Program& program, const Rule& rule);
Program rewrite(const Program& program, const Rule& rule, const Retype& retype);

// For each node whether an output, a phase or an input needs it.
std::vector<bool> live_nodes(const Program& program);

// One operand of a live node; or, without a user, what an output, a phase or an input holds.
struct Use {
  Id used, user;
};
std::vector<Use> uses(const Program& program);

}  // namespace imp
