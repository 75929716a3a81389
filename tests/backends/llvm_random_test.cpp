// Random Programs: two phases over numbers of both types, truths and tables, bit for bit as the interpreter
// has them.
#include <random>

#include "tests/backends/llvm_support.h"

namespace imp {
namespace {

class Generator {
 public:
  Generator(unsigned seed, bool upward) : random_(seed), upward_(upward) {
    for (int i = 0; i < op_count; ++i) {
      const Op op = static_cast<Op>(i);
      const OpKind kind = info(op).kind;
      if (kind == OpKind::elementary || kind == OpKind::packet || kind == OpKind::structure ||
          takes_integers(op))
        continue;
      if (op == Op::fma || op == Op::fma_up || (rounds_up(op) && !upward)) continue;  // fused here, not there
      ops_.push_back(op);
    }
  }

  Program program() {
    Program& p = program_;
    p.name = "random";
    see(add_input(p, "a", f32, Rate::frame));
    see(add_input(p, "b", f64, Rate::cell));
    see(add_input(p, "given", table_of(f32, 6), Rate::cell));
    see(add_input(p, "flag", truth, Rate::frame));
    see(p.graph.constant(f32, 0.1));
    see(p.graph.constant(f64, -3));
    nodes(8);
    see(add_input(p, "x", f32, Rate::ray));
    see(add_input(p, "y", f64, Rate::ray));
    see(add_input(p, "here", truth, Rate::ray));
    nodes(15);
    for (std::uint32_t i = 0; i < 2; ++i) {
      phase(i);
      nodes(6);
    }
    for (const Type type : {f32, f64, truth})
      for (int i = 0; i < 3; ++i)
        p.outputs.push_back({"out" + std::to_string(p.outputs.size()), one_of(type)});
    if (upward_) p.outputs.push_back({"up", p.graph.add(Op::add_up, {one_of(f32), one_of(f32)})});
    return p;
  }

 private:
  std::size_t below(std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_); }

  Type type(Id id) const { return program_.graph[id].type; }
  void see(Id id) { seen_.push_back(id); }

  // Rather one of the last ones than one of the first.
  Id one_of(Type wanted) {
    std::vector<Id> fitting;
    for (const Id id : seen_)
      if (type(id) == wanted) fitting.push_back(id);
    if (below(3) == 0) return fitting[below(fitting.size())];
    return fitting[fitting.size() - 1 - below(std::min<std::size_t>(fitting.size(), 6))];
  }
  Type real_type() { return below(2) == 0 ? f32 : f64; }

  void nodes(int count) {
    for (int i = 0; i < count; ++i) see(node());
  }

  Id node() {
    Graph& graph = program_.graph;
    const Type real = real_type();
    if (const auto kind = below(12); kind == 0) {
      const Type table = known_table();
      return graph.add(Op::load, {one_of(table), one_of(real)});
    } else if (kind == 1) {
      const Type table = known_table();
      return graph.add(Op::store, {one_of(table), one_of(real), one_of(table.element())});
    } else if (kind == 2) {
      const Type table = table_of(real, below(2) == 0 ? 3u : 9u);
      return graph.fill(table, one_of(real));
    }
    const Op op = ops_[below(ops_.size())];
    std::vector<Id> args;
    for (int i = 0; i < info(op).arity; ++i) {
      Type wanted = real;
      if (info(op).kind == OpKind::logic || (info(op).kind == OpKind::choice && i == 0)) wanted = truth;
      if (info(op).kind == OpKind::convert) wanted = op == Op::widen ? f32 : f64;
      args.push_back(one_of(wanted));
    }
    return graph.add(op, args);
  }

  Type known_table() {
    std::vector<Type> tables;
    for (const Id id : seen_)
      if (type(id).is_table()) tables.push_back(type(id));
    return tables[below(tables.size())];
  }

  void phase(std::uint32_t number) {
    Program& p = program_;
    Phase phase;
    phase.name = "phase" + std::to_string(number);
    phase.steps = static_cast<std::uint32_t>(1 + below(12));
    phase.enter = below(2) == 0 ? p.graph.constant(true) : one_of(truth);
    const auto before = seen_;
    for (const Type type : {f32, f64, f32, truth, known_table(), known_table()}) {
      const auto i = static_cast<std::uint32_t>(phase.states.size());
      const Id init = one_of(type);
      const Id now = p.graph.leaf(Op::state, type, pair_of(number, i));
      const Id result = p.graph.leaf(Op::result, type, pair_of(number, i));
      phase.states.push_back({"s" + std::to_string(i), type, now, result, init, now});
    }
    for (const State& state : phase.states) see(state.id);
    nodes(20);
    for (State& state : phase.states) state.next = one_of(state.type);
    phase.again = one_of(truth);
    seen_ = before;
    for (const State& state : phase.states) see(state.result);
    p.phases.push_back(std::move(phase));
  }

  std::mt19937 random_;
  bool upward_;
  std::vector<Op> ops_;
  std::vector<Id> seen_;
  Program program_;
};

TEST(LlvmRandom, programs_agree_with_the_interpreter) {
  Column flags;
  for (int i = 0; i <= 64; ++i) flags.push_back(i % 3 == 1 ? 1 : 0);
  const std::vector<Column> inputs{{0.7f},        {-2.25}, {1, -2, 3, 0.5, 7, -1}, {1}, ramp(-3, 0.21),
                                   ramp(9, -0.4), flags};
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const Program program = Generator(seed, seed % 3 == 0).program();
    const auto reference = interpret(program);
    for (const CpuTarget& target : targets_here()) {
      const auto kernel = compiled(program, target);
      for (const std::size_t size : {1u, 7u, 33u, 65u})
        ASSERT_NO_FATAL_FAILURE(expect_same(run(*kernel, inputs, size), run(*reference, inputs, size),
                                            target.name + ", seed " + std::to_string(seed)))
            << to_text(program);
      if (HasFatalFailure()) FAIL() << to_text(program);
    }
  }
}

}  // namespace
}  // namespace imp
