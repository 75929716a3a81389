#include "ir/program.h"

#include <algorithm>
#include <ranges>

#include "ir/regions.h"

namespace imp {
namespace {

// What outputs need: nodes, and the states behind their leaves.
class Needed {
 public:
  explicit Needed(const Program& program) : nodes_(program.graph.size()), program_(program) {
    for (const Phase& phase : program.phases) states_.emplace_back(phase.states.size());
    for (const Input& input : program.inputs) need(input.id);
    for (const Output& output : program.outputs) need(output.id);
    while (!open_.empty()) {
      const Id id = open_.back();
      open_.pop_back();
      visit(program.graph[id]);
    }
  }

  bool node(Id id) const { return nodes_[id.index]; }
  bool state(std::size_t phase, std::size_t i) const { return states_[phase][i]; }
  bool phase(std::size_t i) const { return std::ranges::find(states_[i], true) != states_[i].end(); }

 private:
  void need(Id id) {
    if (nodes_[id.index]) return;
    nodes_[id.index] = true;
    open_.push_back(id);
  }

  void visit(const Node& node) {
    for (const Id arg : node.args) need(arg);
    if (node.op != Op::state && node.op != Op::result) return;
    const Phase& phase = program_.phases[node.high()];
    const State& state = phase.states[node.low()];
    states_[node.high()][node.low()] = true;
    for (const Id id : {phase.enter, phase.again, state.init, state.next}) need(id);
  }

  std::vector<bool> nodes_;
  std::vector<std::vector<bool>> states_;
  const Program& program_;
  std::vector<Id> open_;
};

// The place of every state after the dead ones are gone.
class Renumbered {
 public:
  Renumbered(const Program& program, const Needed& needed) {
    std::uint32_t phase = 0;
    for (std::size_t i = 0; i < program.phases.size(); ++i) {
      std::uint32_t state = 0;
      auto& row = places_.emplace_back(program.phases[i].states.size());
      for (std::size_t k = 0; k < row.size(); ++k)
        if (needed.state(i, k)) row[k] = pair_of(phase, state++);
      if (needed.phase(i)) ++phase;
    }
  }
  std::uint64_t operator()(const Node& leaf) const { return places_[leaf.high()][leaf.low()]; }

 private:
  std::vector<std::vector<std::uint64_t>> places_;
};

std::uint64_t stirred(std::uint64_t seed, std::uint64_t value) {
  seed = (seed ^ value) * 0x9e3779b97f4a7c15u;
  return seed ^ (seed >> 29);
}

// The needed nodes, operands first, as phases and outputs reach them: an order that does not depend
// on the one they were built in, which C++ leaves open in f(a * b, c * d). Operands that commute are
// told apart by what they compute.
class Order {
 public:
  Order(const Program& program, const Needed& needed, const Renumbered& place)
      : graph_(program.graph), meaning_(graph_.size()), seen_(graph_.size()) {
    for (std::uint32_t i = 0; i < graph_.size(); ++i)
      if (needed.node(Id{i})) meaning_[i] = meaning(graph_[Id{i}], place);

    for (const Input& input : program.inputs) visit(input.id);
    for (std::size_t p = 0; p < program.phases.size(); ++p) {
      if (!needed.phase(p)) continue;
      const Phase& phase = program.phases[p];
      visit(phase.enter);
      for (std::size_t s = 0; s < phase.states.size(); ++s)
        if (needed.state(p, s)) visit(phase.states[s].init);
      for (std::size_t s = 0; s < phase.states.size(); ++s)
        if (needed.state(p, s)) visit(phase.states[s].next);
      visit(phase.again);
    }
    for (const Output& output : program.outputs) visit(output.id);
  }

  std::vector<Id> nodes;

 private:
  std::uint64_t meaning(const Node& node, const Renumbered& place) const {
    const bool moves = node.op == Op::state || node.op == Op::result;
    std::uint64_t hash =
        stirred(static_cast<std::uint64_t>(node.op), static_cast<std::uint64_t>(node.type.scalar));
    hash = stirred(stirred(hash, node.type.length), moves ? place(node) : node.payload);
    for (const Id arg : operands(node)) hash = stirred(hash, meaning_[arg.index]);
    return hash;
  }

  std::vector<Id> operands(const Node& node) const {
    std::vector<Id> args(node.args.begin(), node.args.end());
    if (commutes(node.op) && meaning_[args[1].index] < meaning_[args[0].index]) std::swap(args[0], args[1]);
    return args;
  }

  void visit(Id root) {
    std::vector<std::pair<Id, bool>> open{{root, false}};  // true: its operands are done
    while (!open.empty()) {
      const auto [id, done] = open.back();
      open.pop_back();
      if (done) nodes.push_back(id);
      if (done || seen_[id.index]) continue;
      seen_[id.index] = true;
      open.emplace_back(id, true);
      const std::vector<Id> args = operands(graph_[id]);
      for (std::size_t i = args.size(); i-- > 0;) open.emplace_back(args[i], false);
    }
  }

  const Graph& graph_;
  std::vector<std::uint64_t> meaning_;  // by node
  std::vector<bool> seen_;
};

bool same_callees(const Program& a, const Program& b) {
  return std::ranges::equal(a.callees, b.callees,
                            [](const auto& p, const auto& q) { return p == q || *p == *q; });
}

}  // namespace

const Output* Program::output(std::string_view wanted) const {
  const auto it = std::ranges::find(outputs, wanted, &Output::name);
  return it == outputs.end() ? nullptr : &*it;
}

const Input* Program::input(std::string_view wanted) const {
  const auto it = std::ranges::find(inputs, wanted, &Input::name);
  return it == inputs.end() ? nullptr : &*it;
}

Id add_input(Program& program, std::string name, Type type, Rate rate) {
  const Id id = program.graph.leaf(Op::input, type, program.inputs.size());
  program.inputs.push_back({std::move(name), type, rate, id});
  return id;
}

bool rounds_up(const Program& program) {
  const Needed needed(program);
  for (std::uint32_t i = 0; i < program.graph.size(); ++i)
    if (needed.node(Id{i}) && rounds_up(program.graph[Id{i}].op)) return true;
  return std::ranges::any_of(program.callees, [](const auto& callee) { return rounds_up(*callee); });
}

Program compact(const Program& program) {
  const Needed needed(program);
  const Renumbered place(program, needed);
  const auto region = regions(program);

  std::vector<std::vector<Id>> order(Region::after_phase(program.phases.size()).rank);
  for (const Id id : Order(program, needed, place).nodes) order[region[id.index].rank].push_back(id);

  Program result{.name = program.name, .callees = program.callees};
  std::vector<Id> moved(program.graph.size());
  for (const Input& input : program.inputs)
    moved[input.id.index] = add_input(result, input.name, input.type, input.rate);
  for (const Id id : order | std::views::join) {
    const Node node = program.graph[id];
    std::vector<Id> args;
    for (const Id arg : node.args) args.push_back(moved[arg.index]);
    moved[id.index] = rebuild(result.graph, node, args,
                              node.op == Op::state || node.op == Op::result ? place(node) : node.payload);
    result.graph.set_span(moved[id.index], program.graph.span(id));
    result.graph.set_name(moved[id.index], program.graph.name(id));
  }

  for (std::size_t i = 0; i < program.phases.size(); ++i) {
    if (!needed.phase(i)) continue;
    const Phase& from = program.phases[i];
    Phase phase{from.name, {}, moved[from.enter.index], moved[from.again.index], from.steps};
    const auto p = static_cast<std::uint32_t>(result.phases.size());
    for (std::size_t k = 0; k < from.states.size(); ++k) {
      if (!needed.state(i, k)) continue;
      const State& state = from.states[k];
      const std::uint64_t at = pair_of(p, static_cast<std::uint32_t>(phase.states.size()));
      phase.states.push_back({state.name, state.type, result.graph.leaf(Op::state, state.type, at),
                              result.graph.leaf(Op::result, state.type, at), moved[state.init.index],
                              moved[state.next.index]});
    }
    result.phases.push_back(std::move(phase));
  }
  for (const Output& output : program.outputs)
    result.outputs.push_back({output.name, moved[output.id.index]});
  return result;
}

// Both are brought into one graph, where equal nodes have equal ids.
bool operator==(const Program& left, const Program& right) {
  const Program a = compact(left), b = compact(right);
  if (a.graph.size() != b.graph.size()) return false;
  Graph both = a.graph;
  std::vector<Id> moved;
  for (std::uint32_t i = 0; i < b.graph.size(); ++i) {
    const Node node = b.graph[Id{i}];
    std::vector<Id> args;
    for (const Id arg : node.args) args.push_back(moved[arg.index]);
    moved.push_back(rebuild(both, node, args, node.payload));
  }

  const auto same = [&](Id p, Id q) { return p == moved[q.index]; };
  const auto same_input = [](const Input& p, const Input& q) {
    return p.name == q.name && p.type == q.type && p.rate == q.rate;
  };
  const auto same_output = [&](const Output& p, const Output& q) {
    return p.name == q.name && same(p.id, q.id);
  };
  const auto same_state = [&](const State& p, const State& q) {
    return p.name == q.name && p.type == q.type && same(p.init, q.init) && same(p.next, q.next);
  };
  const auto same_phase = [&](const Phase& p, const Phase& q) {
    return p.name == q.name && same(p.enter, q.enter) && same(p.again, q.again) && p.steps == q.steps &&
           std::ranges::equal(p.states, q.states, same_state);
  };
  return a.name == b.name && std::ranges::equal(a.inputs, b.inputs, same_input) &&
         std::ranges::equal(a.outputs, b.outputs, same_output) &&
         std::ranges::equal(a.phases, b.phases, same_phase) && same_callees(a, b);
}

}  // namespace imp
