// Random Programs, all legal, for tests of passes and backends; and how to make a failing one small.
//
//   const Program p = random_program(seed, {.nodes = 40, .phases = 1});
//   if (is_wrong(p)) FAIL() << "seed " << seed << '\n' << to_text(shrink(p, is_wrong));
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <tuple>
#include <vector>

#include "ir/expr.h"
#include "ir/program.h"
#include "ir/verify.h"
#include "tests/support/random.h"

namespace imp::test {

struct RandomOptions {
  std::size_t nodes = 30;  // about; split over the phases
  std::size_t phases = 0;
  bool f32 = true;  // at least one of the two
  bool f64 = true;
  bool upward = false;      // upward ops, so that all of it rounds upward
  bool elementary = false;  // exp, sin, …
  bool tables = false;
  bool calls = false;
  bool packets = false;           // any, all
  bool odd_names = false;         // that have to be quoted, or that clash
  bool special_constants = true;  // infinities, NaN, denormals, -0
};

class RandomProgram {
 public:
  RandomProgram(std::uint64_t seed, const RandomOptions& options) : random_(seed), options_(options) {}

  Program make() {
    program_.name = options_.odd_names ? odd("random") : "random";
    if (options_.calls) callees();
    inputs();
    constants();
    const std::size_t share = options_.nodes / (2 * options_.phases + 1) + 1;
    nodes(share);
    for (std::size_t i = 0; i < options_.phases; ++i) phase(i, share), nodes(share);
    outputs();
    return std::move(program_);
  }

 private:
  Graph& graph() { return program_.graph; }
  Type type(Id id) { return graph()[id].type; }

  std::string odd(const std::string& name) {
    static constexpr const char* tails[] = {"", " ", ".t", "\"", "\\", "\n", "-1", "'", "é", "_2", "#", "@2"};
    return name + tails[random_.below(std::size(tails))];
  }
  std::string name(const std::string& base, std::size_t i) {
    return (options_.odd_names ? odd(base) : base) + std::to_string(i);
  }

  Type number() {
    if (!options_.f64) return imp::f32;
    if (!options_.f32) return imp::f64;
    return random_.one_in(2) ? imp::f32 : imp::f64;
  }
  Type table() { return table_of(number(), static_cast<std::uint32_t>(1 + random_.below(5))); }
  Type value() { return random_.one_in(5) ? truth : number(); }

  // A value of that type: more often a late one. Made of another if there is none.
  Id pick(Type wanted) {
    std::vector<Id> fit;
    for (const Id id : pool_)
      if (type(id) == wanted) fit.push_back(id);
    if (fit.empty())
      return wanted.is_table() ? graph().fill(wanted, pick(wanted.element())) : constant(wanted);
    const std::size_t last = std::min<std::size_t>(fit.size(), 8);
    return random_.one_in(3) ? fit[random_.below(fit.size())] : fit[fit.size() - 1 - random_.below(last)];
  }

  Id constant(Type wanted) {
    if (wanted == truth) return graph().constant(random_.one_in(2));
    static constexpr double plain[] = {0, 1, 2, -1, 0.5, 0.1, 3, -2.5, 1e-3, 1e3};
    static constexpr double special[] = {
        -0.0, INFINITY, -INFINITY, NAN, 1e-45, 5e-324, 3.4028234663852886e38, 1e300, 1e-300};
    if (options_.special_constants && random_.one_in(4))
      return graph().constant(wanted, special[random_.below(std::size(special))]);
    if (random_.one_in(3)) return graph().constant(wanted, random_.between(-10, 10));
    return graph().constant(wanted, plain[random_.below(std::size(plain))]);
  }

  void callees() {
    RandomOptions inner = options_;
    inner.nodes = options_.nodes / 4 + 2;
    inner.phases = random_.below(2);
    inner.calls = random_.one_in(3) && options_.nodes > 8;
    for (std::size_t i = 0, n = 1 + random_.below(2); i < n; ++i) {
      program_.callees.push_back(std::make_shared<Program>(RandomProgram(random_.bits(), inner).make()));
    }
  }

  void inputs() {
    for (std::size_t i = 0, n = 2 + random_.below(4); i < n; ++i) input(name("x", i), value(), 3);
    if (options_.tables && random_.one_in(2)) input("table", table(), 2);
  }

  void input(std::string name, Type type, std::size_t rates) {
    pool_.push_back(add_input(program_, std::move(name), type, static_cast<Rate>(random_.below(rates))));
  }

  void constants() {
    for (int i = 0; i < 3; ++i) pool_.push_back(constant(number()));
  }

  void nodes(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const Id id = node();
      if (options_.odd_names && random_.one_in(3))
        graph().set_name(id, random_.one_in(2) ? odd("n") : odd("x0"));
      pool_.push_back(id);
    }
  }

  Id node() {
    if (options_.tables && random_.one_in(5)) return of_table();
    if (options_.calls && random_.one_in(8)) return call();
    for (;;) {
      const Op op = some_op();
      switch (info(op).kind) {
        case OpKind::upward:
          if (!options_.upward) continue;
          return of_numbers(op);
        case OpKind::elementary:
          if (!options_.elementary) continue;
          return of_numbers(op);
        case OpKind::real:    return op == Op::powi ? power() : of_numbers(op);
        case OpKind::compare: return of_numbers(op);
        case OpKind::logic:   return of(op, truth);
        case OpKind::packet:
          if (!options_.packets) continue;
          return of(op, truth);
        case OpKind::choice: {
          const Type t = number();
          return graph().add(op, {pick(truth), pick(t), pick(t)});
        }
        case OpKind::convert:
          if (!options_.f32 || !options_.f64 || (rounds_up(op) && !options_.upward)) continue;
          return of(op, op == Op::widen ? imp::f32 : imp::f64);
        case OpKind::structure: continue;
      }
    }
  }

  Id of(Op op, Type type) {
    std::vector<Id> args;
    for (int i = 0; i < info(op).arity; ++i) args.push_back(pick(type));
    return graph().add(op, args);
  }
  Id of_numbers(Op op) { return of(op, number()); }

  // Any but `chebyshev`, which comes with the powers.
  Op some_op() {
    constexpr auto skipped = static_cast<std::size_t>(Op::chebyshev);
    const std::size_t i = random_.below(static_cast<std::size_t>(op_count) - 1);
    return static_cast<Op>(i < skipped ? i : i + 1);
  }

  // a^n with n from -3 to 4; T_5(a), or the slope of T_6.
  Id power() {
    const Type t = number();
    const Id a = pick(t);
    const double n = static_cast<double>(random_.below(10)) - 3;
    const auto integer = [&](double k) { return graph().constant(t, k); };
    if (n < 5) return graph().add(Op::powi, {a, integer(n)});
    return graph().add(Op::chebyshev, {a, integer(n), integer(n - 5)});
  }

  Id of_table() {
    std::vector<Type> known;
    for (const Id id : pool_)
      if (type(id).is_table()) known.push_back(type(id));
    const Type t = known.empty() ? table() : known[random_.below(known.size())];
    switch (random_.below(5)) {
      case 0:  return graph().fill(t, pick(t.element()));
      case 1:
      case 2:  return graph().add(Op::store, {pick(t), pick(number()), pick(t.element())});
      default: return graph().add(Op::load, {pick(t), pick(number())});
    }
  }

  Id call() {
    const auto which = static_cast<std::uint32_t>(random_.below(program_.callees.size()));
    const Program& callee = *program_.callees[which];
    std::vector<Id> args;
    for (const Input& input : callee.inputs) args.push_back(pick(input.type));
    Id last;
    for (std::uint32_t i = 0; i < callee.outputs.size(); ++i) {
      last = graph().call(callee.graph[callee.outputs[i].id].type, which, i, args);
      pool_.push_back(last);
    }
    return last;
  }

  void phase(std::size_t i, std::size_t count) {
    const auto index = static_cast<std::uint32_t>(program_.phases.size());
    Phase phase{name("phase", i), {}, pick(truth), {}, static_cast<std::uint32_t>(1 + random_.below(6))};
    const std::vector<Id> before = pool_;
    for (std::uint32_t k = 0, n = static_cast<std::uint32_t>(1 + random_.below(3)); k < n; ++k) {
      const Type t = options_.tables && random_.one_in(3) ? table() : value();
      const bool clash = options_.odd_names && k < program_.inputs.size() && random_.one_in(3);
      const Id init = pick(t);
      const std::uint64_t place = pair_of(index, k);
      phase.states.push_back({clash ? program_.inputs[k].name : name("t", k),
                              t,
                              graph().leaf(Op::state, t, place),
                              graph().leaf(Op::result, t, place),
                              init,
                              {}});
    }
    for (const State& state : phase.states) pool_.push_back(state.id);
    nodes(count);
    for (State& state : phase.states) state.next = random_.one_in(8) ? state.id : pick(state.type);
    phase.again = pick(truth);
    pool_ = before;  // what is inside stays there
    for (const State& state : phase.states) pool_.push_back(state.result);
    program_.phases.push_back(std::move(phase));
  }

  void outputs() {
    for (std::size_t i = 0, n = 1 + random_.below(3); i < n; ++i)
      program_.outputs.push_back({name("out", i), pick(value())});
  }

  Random random_;
  RandomOptions options_;
  Program program_;
  std::vector<Id> pool_;
};

inline Program random_program(std::uint64_t seed, const RandomOptions& options = {}) {
  return RandomProgram(seed, options).make();
}

// `program` with node `from` replaced everywhere: by `to`, which comes before it, or by 1.
inline Program with_replaced(const Program& program, Id from, Id to = {}) {
  Program result{program.name, {}, program.inputs, program.phases, program.outputs, program.callees};
  std::vector<Id> moved;
  for (std::uint32_t i = 0; i < program.graph.size(); ++i) {
    const Node node = program.graph[Id{i}];
    std::vector<Id> args;
    for (const Id arg : node.args) args.push_back(moved[arg.index]);
    if (Id{i} != from)
      moved.push_back(rebuild(result.graph, node, args, node.payload));
    else if (to.valid())
      moved.push_back(moved[to.index]);
    else
      moved.push_back(node.type.is_truth() ? result.graph.constant(true)
                                           : result.graph.constant(node.type, 1));
  }
  const auto move = [&](Id& id) { id = moved[id.index]; };
  for (Input& input : result.inputs) move(input.id);
  for (Output& output : result.outputs) move(output.id);
  for (Phase& phase : result.phases) {
    move(phase.enter), move(phase.again);
    for (State& state : phase.states) move(state.id), move(state.result), move(state.init), move(state.next);
  }
  return compact(result);
}

// A smaller Program that fails too: outputs are left out and nodes replaced by their operands or by
// 1, as long as `fails` holds. The inputs stay.
inline Program shrink(Program program, const std::function<bool(const Program&)>& fails) {
  // Falls at every step, so that there is an end: nodes, those that are computed, outputs.
  const auto weight = [](const Program& p) {
    std::size_t computed = 0;
    for (std::uint32_t i = 0; i < p.graph.size(); ++i) computed += p.graph[Id{i}].op != Op::constant;
    return std::tuple(p.graph.size(), computed, p.outputs.size());
  };
  const auto take = [&](Program candidate) {
    if (weight(candidate) >= weight(program) || !verify(candidate).empty() || !fails(candidate)) return false;
    program = std::move(candidate);
    return true;
  };
  program = compact(program);
  for (bool smaller = true; smaller;) {
    smaller = false;
    for (std::size_t i = program.outputs.size(); i-- > 0 && program.outputs.size() > 1;) {
      Program candidate = program;
      candidate.outputs.erase(candidate.outputs.begin() + static_cast<std::ptrdiff_t>(i));
      smaller = take(compact(candidate)) || smaller;
    }
    for (std::uint32_t i = static_cast<std::uint32_t>(program.graph.size()); i-- > 0;) {
      if (i >= program.graph.size()) continue;
      const Node node = program.graph[Id{i}];
      if (node.op == Op::constant || node.op == Op::input) continue;
      std::vector<Id> ways;  // an invalid id stands for 1
      for (const Id arg : node.args)
        if (program.graph[arg].type == node.type) ways.push_back(arg);
      if (!node.type.is_table()) ways.push_back({});
      bool replaced = false;
      for (std::size_t k = 0; k < ways.size() && !replaced; ++k)
        replaced = take(with_replaced(program, Id{i}, ways[k]));
      smaller = smaller || replaced;
    }
  }
  return program;
}

}  // namespace imp::test
