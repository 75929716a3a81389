#include "ir/loop.h"

#include <string_view>
#include <unordered_set>

#include "ir/assert.h"

namespace imp {

Loop::Loop(Program& program, std::string name, std::uint32_t steps)
    : program_(&program), index_(program.phases.size()) {
  std::unordered_set<std::string_view> taken;
  for (const Phase& p : program.phases) taken.insert(p.name);
  const std::string wanted = name;
  for (int i = 2; taken.contains(name); ++i) name = wanted + std::to_string(i);
  const Id yes = program.graph.constant(true);
  program.phases.push_back({std::move(name), {}, yes, yes, steps});
}

Id Loop::add_state(std::string name, Id init) {
  Phase& p = phase();
  const auto place = pair_of(static_cast<std::uint32_t>(index_), static_cast<std::uint32_t>(p.states.size()));
  const Type type = program_->graph[init].type;
  const Id id = program_->graph.leaf(Op::state, type, place);
  const Id result = program_->graph.leaf(Op::result, type, place);
  p.states.push_back({std::move(name), type, id, result, init, id});
  return id;
}

void Loop::set_next(Id state, Id value) {
  const Node node = program_->graph[state];
  IMP_ASSERT(node.op == Op::state && node.high() == index_, "a state of this phase");
  phase().states[node.low()].next = value;
}

Id Loop::result_of(Id state) const {
  const Node node = program_->graph[state];
  IMP_ASSERT(node.op == Op::state && node.high() == index_, "a state of this phase");
  return phase().states[node.low()].result;
}

Expr Loop::state(std::string name, Expr init) {
  return {&program_->graph, add_state(std::move(name), init.id)};
}

Truth Loop::state(std::string name, Truth init) {
  return {&program_->graph, add_state(std::move(name), init.id)};
}

void Loop::next(Expr state, Expr value) { set_next(state.id, value.id); }
void Loop::next(Truth state, Truth value) { set_next(state.id, value.id); }
void Loop::enter_if(Truth condition) { phase().enter = condition.id; }
void Loop::again_while(Truth condition) { phase().again = condition.id; }

Expr Loop::result(Expr state) const { return {&program_->graph, result_of(state.id)}; }
Truth Loop::result(Truth state) const { return {&program_->graph, result_of(state.id)}; }

}  // namespace imp
