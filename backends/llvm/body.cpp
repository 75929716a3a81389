#include "backends/llvm/body.h"

#include <llvm/ADT/EquivalenceClasses.h>

#include <algorithm>
#include <bit>

#include "backends/llvm/ops.h"
#include "ir/assert.h"
#include "ir/regions.h"

namespace imp {
namespace {

using llvm::BasicBlock;
using llvm::Value;

std::vector<bool> nodes_needed(const Program& program, const std::vector<std::vector<Id>>& schedule) {
  std::vector<bool> needed(program.graph.size());
  for (const auto& nodes : schedule)
    for (const Id id : nodes) {
      needed[id.index] = true;
      for (const Id arg : program.graph[id].args) needed[arg.index] = true;
    }
  for (const Output& output : program.outputs) needed[output.id.index] = true;
  for (const Phase& phase : program.phases) {
    needed[phase.enter.index] = needed[phase.again.index] = true;
    for (const State& state : phase.states) needed[state.init.index] = needed[state.next.index] = true;
  }
  return needed;
}

// Of the tables that become one another by stores and by a phase's steps, all lie in registers or none: short
// ones do, and those that have no index but constants.
std::vector<bool> tables_in_registers(const Program& program) {
  const Graph& graph = program.graph;
  llvm::EquivalenceClasses<std::uint32_t> same;
  std::vector<bool> in_memory(graph.size());
  const auto join = [&](Id a, Id b) {
    if (a.valid() && b.valid()) same.unionSets(a.index, b.index);
  };
  for (std::uint32_t i = 0; i < graph.size(); ++i) {
    const Node node = graph[Id{i}];
    if (node.op == Op::store)
      join(Id{i}, node.args[0]);
    else if (node.type.is_table())
      same.insert(i);
    if (node.op != Op::load && node.op != Op::store) continue;
    const Id table = node.args[0];
    if (graph[table].type.length > Tables::short_length && !graph.number(node.args[1]))
      in_memory[table.index] = true;
  }
  for (const Phase& phase : program.phases)
    for (const State& state : phase.states) {
      if (!state.type.is_table()) continue;
      for (const Id id : {state.init, state.next, state.result}) join(state.id, id);
    }
  std::vector<bool> class_in_memory(graph.size());
  for (std::uint32_t i = 0; i < graph.size(); ++i)
    if (in_memory[i]) class_in_memory[same.getOrInsertLeaderValue(i)] = true;
  std::vector<bool> result(graph.size());
  for (std::uint32_t i = 0; i < graph.size(); ++i)
    result[i] = graph[Id{i}].type.is_table() && !class_in_memory[same.getOrInsertLeaderValue(i)];
  return result;
}

llvm::Constant* constant(Packet& p, const Graph& graph, Id id) {
  const Node node = graph[id];
  if (node.type.is_truth()) return p.ir.getInt1(node.payload != 0);
  llvm::Type* type = node.type == f32 ? p.ir.getFloatTy() : p.ir.getDoubleTy();
  return llvm::ConstantFP::get(type, *graph.number(id));
}

}  // namespace

Body::Body(Packet& packet, const Program& program, Callees callees)
    : packet_(packet),
      program_(program),
      callees_(std::move(callees)),
      tables_(packet),
      schedule_(schedule(program)),
      needed_(nodes_needed(program, schedule_)),
      in_registers_(tables_in_registers(program)),
      values_(program.graph.size()) {}

void Body::emit_before_rays() {
  for (std::uint32_t rank = 0; rank < Region::of(Rate::ray).rank; ++rank) compute(schedule_[rank]);
}

void Body::emit_rays() {
  compute(schedule_[Region::of(Rate::ray).rank]);
  for (std::size_t i = 0; i < program_.phases.size(); ++i) {
    phase(i);
    compute(schedule_[Region::after_phase(i).rank]);
  }
}

Value* Body::value(Id id) {
  if (program_.graph[id].op == Op::constant) return constant(packet_, program_.graph, id);
  IMP_ASSERT(values_[id.index] != nullptr, "a node whose operands were computed before it");
  return values_[id.index];
}

void Body::name(Value* value, std::string_view text) {
  if (!text.empty() && llvm::isa<llvm::Instruction>(value) && !value->hasName()) value->setName(text);
}

Index Body::index(Id table, Id number) {
  const Type type = program_.graph[table].type;
  if (const auto constant = program_.graph.number(number)) {
    const double last = type.length - 1;
    return {*constant > 0 ? static_cast<std::uint32_t>(std::min(*constant, last)) : 0u, nullptr};
  }
  return tables_.index(type, value(number));
}

void Body::compute(std::span<const Id> nodes) {
  for (const Id id : nodes) compute(id);
}

void Body::compute(Id id) {
  const Node node = program_.graph[id];
  const bool in_registers = in_registers_[id.index];
  switch (node.op) {
    case Op::fill:  set(id, tables_.fill(node.type, value(node.args[0]), in_registers)); return;
    case Op::store: {
      const Index at = index(node.args[0], node.args[1]);
      set(id, tables_.store(table(node.args[0]), at, value(node.args[2]), in_registers));
      return;
    }
    case Op::load: set(id, tables_.load(table(node.args[0]), index(node.args[0], node.args[1]))); break;
    case Op::call: call(id, node); break;
    default:       {
      std::array<Value*, 3> operands;
      const auto args = std::span(operands).first(node.args.size());
      std::ranges::transform(node.args, args.begin(), [&](Id arg) { return value(arg); });
      packet_.widen_together(args);
      set(id, op_builder(info(node.op).llvm)(packet_, args));
    }
  }
  name(values_[id.index], program_.graph.name(id));
}

// Before the rays the arguments are the same for all of them, and so is the result, in every lane.
void Body::call(Id id, const Node& node) {
  auto& ir = packet_.ir;
  Value* result = ir.CreateExtractValue(call_of(node), node.low());
  if (packet_.active == nullptr) {
    if (node.type.is_truth()) result = packet_.bits_of(result, packet_.rules.mask_bits);
    result = ir.CreateExtractElement(result, std::uint64_t{0});
  }
  set(id, result);
}

Value* Body::call_of(const Node& node) {
  Value*& results = calls_[{node.high(), {node.args.begin(), node.args.end()}}];
  if (results != nullptr) return results;

  const Program& callee = *program_.callees[node.high()];
  Value* mask =
      packet_.active != nullptr ? packet_.usual(packet_.active) : packet_.widen(packet_.ir.getTrue());
  std::vector<Value*> args{mask};
  std::vector<Form> forms;
  for (std::size_t i = 0; i < node.args.size(); ++i) {
    if (callee.inputs[i].type.is_table()) {
      const Table& given = table(node.args[i]);
      const bool shared = given.shared && given.stores.empty();
      args.push_back(shared ? given.memory : tables_.keep(given).memory);
      forms.push_back(shared ? Form::shared_table : Form::lane_table);
    } else {
      Value* given = value(node.args[i]);
      if (callee.inputs[i].rate == Rate::ray || Packet::is_wide(given))
        given = packet_.usual(packet_.widen(given));
      args.push_back(given);
      forms.push_back(Packet::is_wide(given) ? Form::wide : Form::scalar);
    }
  }
  results = packet_.ir.CreateCall(callees_(callee, forms), args, callee.name);
  return results;
}

// One variable of a phase: a value a phi, or a table in scratch memory.
struct Body::Slot {
  std::vector<Value*> first;
  std::vector<llvm::PHINode*> now;
  std::vector<Value*> next;
  Table memory;
};

// before:  first values; to the end unless a ray enters
// loop:    values now -> next ones, chosen for the active rays; again while a ray is active
// end:     last values
void Body::phase(std::size_t number) {
  const Phase& phase = program_.phases[number];
  auto& p = packet_;
  auto* function = p.ir.GetInsertBlock()->getParent();

  std::vector<Slot> slots(phase.states.size());
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const State& state = phase.states[i];
    if (!state.type.is_table())
      slots[i].first = {p.usual(p.widen(value(state.init)))};
    else if (in_registers_[state.id.index])
      slots[i].first = tables_.to_registers(table(state.init)).elements;
    else
      slots[i].memory = tables_.keep(table(state.init));
  }
  Value* outside = p.active;
  Value* entering = p.usual(p.active);
  const bool all_enter = program_.graph.truth_value(phase.enter) == true;
  if (!all_enter) entering = p.both(entering, p.usual(p.widen(value(phase.enter))));

  auto* before = p.ir.GetInsertBlock();
  auto* loop = BasicBlock::Create(p.ir.getContext(), phase.name, function);
  auto* end = BasicBlock::Create(p.ir.getContext(), phase.name + ".end");
  if (all_enter)
    p.ir.CreateBr(loop);
  else
    p.ir.CreateCondBr(p.any(entering), loop, end);

  p.ir.SetInsertPoint(loop);
  auto* step = p.ir.CreatePHI(p.ir.getInt32Ty(), 2, phase.name + ".step");
  auto* active = p.ir.CreatePHI(p.mask_type(), 2, phase.name + ".active");
  p.active = active;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const State& state = phase.states[i];
    for (Value* first : slots[i].first)
      slots[i].now.push_back(p.ir.CreatePHI(first->getType(), 2, state.name));
    if (!state.type.is_table())
      set(state.id, slots[i].now[0]);
    else if (slots[i].first.empty())
      set(state.id, slots[i].memory);
    else
      set(state.id, Tables::in_registers(state.type, {slots[i].now.begin(), slots[i].now.end()}));
  }

  compute(schedule_[Region::in_phase(number).rank]);

  const auto choose = [&](Value* next, Value* now) -> Value* {
    if (next == now) return now;
    return p.select(active, p.usual(p.widen(next)), now);
  };
  std::vector<std::pair<std::size_t, Table>> moves;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const State& state = phase.states[i];
    if (!state.type.is_table()) {
      slots[i].next = {choose(value(state.next), slots[i].now[0])};
    } else if (!slots[i].first.empty()) {
      const auto& elements = table(state.next).in_registers()
                                 ? table(state.next).elements
                                 : tables_.to_registers(table(state.next)).elements;
      for (std::size_t e = 0; e < elements.size(); ++e)
        slots[i].next.push_back(choose(elements[e], slots[i].now[e]));
    } else {
      const Table& next = table(state.next);
      moves.emplace_back(i, next.memory == slots[i].memory.memory ? next : tables_.keep(next));
    }
  }
  for (const auto& [i, next] : moves) tables_.update(slots[i].memory, next, active);

  Value* still = p.both(active, p.usual(p.widen(value(phase.again))));
  Value* steps = p.ir.CreateAdd(step, p.ir.getInt32(1));
  Value* more = p.ir.CreateAnd(p.any(still), p.ir.CreateICmpNE(steps, p.ir.getInt32(phase.steps)));
  auto* latch = p.ir.GetInsertBlock();
  p.ir.CreateCondBr(more, loop, end);
  step->addIncoming(p.ir.getInt32(0), before);
  step->addIncoming(steps, latch);
  active->addIncoming(entering, before);
  active->addIncoming(still, latch);

  end->insertInto(function);
  p.ir.SetInsertPoint(end);
  p.active = outside;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const State& state = phase.states[i];
    std::vector<Value*> last;
    for (std::size_t e = 0; e < slots[i].now.size(); ++e) {
      slots[i].now[e]->addIncoming(slots[i].first[e], before);
      slots[i].now[e]->addIncoming(slots[i].next[e], latch);
      auto* result = p.ir.CreatePHI(slots[i].now[e]->getType(), 2, state.name);
      if (!all_enter) result->addIncoming(slots[i].first[e], before);
      result->addIncoming(slots[i].next[e], latch);
      last.push_back(result);
    }
    if (!state.type.is_table())
      set(state.result, last[0]);
    else if (last.empty())
      set(state.result, slots[i].memory);
    else
      set(state.result, Tables::in_registers(state.type, std::move(last)));
  }
}

}  // namespace imp
