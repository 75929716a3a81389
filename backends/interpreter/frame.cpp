#include "backends/interpreter/frame.h"

#include <algorithm>
#include <cmath>

#include "ir/assert.h"
#include "ir/meaning.h"

namespace imp {

Frame::Frame(const Plan& plan)
    : plan_(plan), graph_(plan.program.graph), values_(plan.start), tables_(plan.table_elements) {
  for (const auto& callee : plan.callees) callees_.push_back(std::make_unique<Frame>(*callee));
}

// Out of line, and everything below it: no arithmetic may move to where the rounding mode is set.
[[gnu::noinline]] void Frame::run_shared() {
  evaluate(Region::constant());
  evaluate(Region::of(Rate::frame));
  evaluate(Region::of(Rate::cell));
}

[[gnu::noinline]] void Frame::run_ray(const Watch& watch) {
  evaluate(Region::of(Rate::ray));
  for (std::size_t i = 0; i < plan_.program.phases.size(); ++i) {
    run_phase(i, watch);
    evaluate(Region::after_phase(i));
  }
}

void Frame::run_phase(std::size_t i, const Watch& watch) {
  const Phase& phase = plan_.program.phases[i];
  for (const State& state : phase.states) copy(*this, state.init, state.id);

  std::uint32_t step = 0;
  bool again = bits(phase.enter) != 0;
  for (; again && step < phase.steps; ++step) {
    if (watch) watch(i, step, true);
    evaluate(Region::in_phase(i));
    again = bits(phase.again) != 0;  // of the states before the step
    take_step(phase);
  }
  if (watch) watch(i, step, false);
  for (const State& state : phase.states) copy(*this, state.id, state.result);
}

// All states change at once: a `next` may be another state.
void Frame::take_step(const Phase& phase) {
  next_.clear();
  for (const State& state : phase.states) {
    const auto next = all_bits(state.next);
    next_.insert(next_.end(), next.begin(), next.end());
  }
  std::span<const std::uint64_t> rest = next_;
  for (const State& state : phase.states) {
    const auto values = all_bits(state.id);
    std::ranges::copy(rest.first(values.size()), values.begin());
    rest = rest.subspan(values.size());
  }
}

void Frame::evaluate(Region region) {
  for (const Id id : plan_.schedule[region.rank]) evaluate(id);
}

void Frame::evaluate(Id id) {
  const Node node = graph_[id];
  switch (info(node.op).kind) {
    case OpKind::real:
    case OpKind::elementary:
    case OpKind::upward:
      return node.type == f32 ? evaluate_real<float>(id, node) : evaluate_real<double>(id, node);
    case OpKind::compare:
      return graph_[node.args[0]].type == f32 ? evaluate_compare<float>(id, node)
                                              : evaluate_compare<double>(id, node);
    case OpKind::logic:
      return set(id, meaning::truth(node.op, bits(node.args[0]) != 0, bits(node.args.back()) != 0));
    case OpKind::choice:    return copy(*this, node.args[bits(node.args[0]) != 0 ? 1 : 2], id);
    case OpKind::convert:   return evaluate_convert(id, node);
    case OpKind::packet:    return copy(*this, node.args[0], id);  // a packet is one ray
    case OpKind::structure: return node.op == Op::call ? call(id, node) : evaluate_table(id, node);
  }
}

template <class T>
T Frame::number(Id id) const {
  if constexpr (std::is_same_v<T, float>)
    return std::bit_cast<float>(static_cast<std::uint32_t>(bits(id)));
  else
    return std::bit_cast<double>(bits(id));
}

template <class T>
void Frame::evaluate_real(Id id, const Node& node) {
  const auto operand = [&](std::size_t i) { return i < node.args.size() ? number<T>(node.args[i]) : T(0); };
  set(id, meaning::real<T>(node.op, operand(0), operand(1), operand(2)));
}

template <class T>
void Frame::evaluate_compare(Id id, const Node& node) {
  set(id, meaning::truth<T>(node.op, number<T>(node.args[0]), number<T>(node.args[1])));
}

void Frame::evaluate_convert(Id id, const Node& node) {
  if (node.op == Op::widen)
    set(id, static_cast<double>(number<float>(node.args[0])));
  else
    set(id, static_cast<float>(number<double>(node.args[0])));
}

void Frame::evaluate_table(Id id, const Node& node) {
  switch (node.op) {
    case Op::fill: std::ranges::fill(all_bits(id), bits(node.args[0])); return;
    case Op::load: {
      const auto table = all_bits(node.args[0]);
      return set_bits(id, table[index(node.args[1], table.size())]);
    }
    case Op::store: {
      copy(*this, node.args[0], id);
      const auto table = all_bits(id);
      table[index(node.args[1], table.size())] = bits(node.args[2]);
      return;
    }
    default: IMP_ASSERT(false, "a node that is computed");
  }
}

std::size_t Frame::index(Id id, std::size_t length) const {
  const double wanted = graph_[id].type == f32 ? number<float>(id) : number<double>(id);
  const double last = static_cast<double>(length - 1);
  return wanted >= 0 ? static_cast<std::size_t>(std::floor(std::min(wanted, last))) : 0;
}

// One call serves all of its nodes, which differ in the output they take.
void Frame::call(Id id, const Node& node) {
  Frame& callee = *callees_[node.high()];
  const Program& program = callee.plan_.program;
  for (std::size_t i = 0; i < program.inputs.size(); ++i)
    callee.copy(*this, node.args[i], program.inputs[i].id);
  callee.run_shared();
  callee.run_ray();
  for (const Id output : plan_.calls.at(id)) copy(callee, program.outputs[graph_[output].low()].id, output);
}

std::span<const std::uint64_t> Frame::all_bits(Id id) const {
  const Type type = graph_[id].type;
  if (!type.is_table()) return std::span(values_).subspan(id.index, 1);
  return std::span(tables_).subspan(values_[id.index], type.length);
}

std::span<std::uint64_t> Frame::all_bits(Id id) {
  const Type type = graph_[id].type;
  if (!type.is_table()) return std::span(values_).subspan(id.index, 1);
  return std::span(tables_).subspan(values_[id.index], type.length);
}

void Frame::copy(const Frame& source, Id from, Id to) {
  std::ranges::copy(source.all_bits(from), all_bits(to).begin());
}

}  // namespace imp
