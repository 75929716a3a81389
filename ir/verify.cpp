#include "ir/verify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "ir/chebyshev.h"

namespace imp {
namespace {

constexpr std::uint32_t longest_table = 1u << 16;

// Checks one Program, rule by rule; the first one broken stays in `wrong`.
class Verifier {
 public:
  explicit Verifier(const Program& program) : program_(program), graph_(program.graph) {}

  std::string run() {
    names();
    callees();
    leaves_of_tables();
    for (std::uint32_t i = 0; i < graph_.size() && ok(); ++i) node(Id{i});
    if (ok()) uses();
    return wrong_;
  }

 private:
  bool ok() const { return wrong_.empty(); }

  // Says so unless `condition` holds.
  template <class... Args>
  bool require(bool condition, fmt::format_string<Args...> form, Args&&... args) {
    if (!condition && ok()) wrong_ = fmt::format(form, std::forward<Args>(args)...);
    return condition && ok();
  }

  // The same, of a node.
  template <class... Args>
  bool require(Id id, bool condition, fmt::format_string<Args...> form, Args&&... args) {
    if (!condition && ok()) {
      wrong_ = fmt::format("node {} ({})", id.index, info(graph_[id].op).name);
      if (const auto name = graph_.name(id); !name.empty()) wrong_ += fmt::format(" '{}'", name);
      wrong_ += ": " + fmt::format(form, std::forward<Args>(args)...);
    }
    return condition && ok();
  }

  bool exists(Id id) const { return id.index < graph_.size(); }

  template <class Named>
  void unique(std::string_view what, const std::vector<Named>& all) {
    std::unordered_set<std::string_view> seen;
    for (const Named& one : all) {
      require(!one.name.empty(), "an unnamed {}", what);
      require(seen.insert(one.name).second, "two {}s are called '{}'", what, one.name);
    }
  }

  void names() {
    unique("input", program_.inputs);
    unique("output", program_.outputs);
    unique("phase", program_.phases);
    for (const Phase& phase : program_.phases) unique("state", phase.states);
  }

  void callees() {
    std::unordered_set<const Program*> seen;
    for (std::size_t i = 0; i < program_.callees.size() && ok(); ++i) {
      const auto& callee = program_.callees[i];
      if (!require(callee != nullptr, "callee {} is missing", i)) return;
      require(seen.insert(callee.get()).second, "callee '{}' is listed twice", callee->name);
      const std::string inner = verify(*callee);
      require(inner.empty(), "in callee '{}': {}", callee->name, inner);
    }
  }

  // Inputs and states, as their tables have them: before any node can be looked up there.
  void leaves_of_tables() {
    const auto leaf = [&](Id id, Op op, Type type, std::uint64_t payload, std::string_view name) {
      if (!require(exists(id), "'{}' has no node", name)) return;
      const Node node = graph_[id];
      require(node.op == op && node.payload == payload && node.type == type, "the node of '{}' is not its {}",
              name, info(op).name);
    };
    for (std::size_t i = 0; i < program_.inputs.size(); ++i) {
      const Input& input = program_.inputs[i];
      leaf(input.id, Op::input, input.type, i, input.name);
      require(!input.type.is_table() || input.rate != Rate::ray,
              "input '{}' is a table of rate ray; a table has rate frame or cell", input.name);
    }
    for (std::size_t p = 0; p < program_.phases.size(); ++p) {
      const Phase& phase = program_.phases[p];
      require(phase.steps > 0, "phase '{}' has no steps", phase.name);
      for (std::size_t s = 0; s < phase.states.size(); ++s) {
        const State& state = phase.states[s];
        const auto place = pair_of(static_cast<std::uint32_t>(p), static_cast<std::uint32_t>(s));
        leaf(state.id, Op::state, state.type, place, state.name);
        leaf(state.result, Op::result, state.type, place, state.name);
      }
    }
  }

  void node(Id id) {
    const Node node = graph_[id];
    for (const Id arg : node.args)
      if (!require(id, arg < id, "operand {} does not come before it", arg.index)) return;
    const bool table = node.type.is_table();
    require(id, !table || node.type.scalar != Scalar::truth, "a table of truths");
    require(id, node.type.length <= longest_table, "a table of {} values; {} is the most", node.type.length,
            longest_table);

    switch (node.op) {
      case Op::constant: return constant(id, node);
      case Op::input:
        require(id, node.payload < program_.inputs.size() && program_.inputs[node.payload].id == id,
                "no such input");
        return;
      case Op::state:
      case Op::result: return state(id, node);
      case Op::fill:
        require(id, node.args.size() == 1 && table && graph_[node.args[0]].type == node.type.element(),
                "wants a value of the type of its elements");
        return;
      case Op::call: return call(id, node);
      default:       return operation(id, node);
    }
  }

  void constant(Id id, const Node& node) {
    require(id, !node.type.is_table() && node.args.empty(), "not one value");
    const std::uint64_t most = node.type.is_truth() ? 1 : node.type == f32 ? 0xffffffffu : ~std::uint64_t{0};
    require(id, node.payload <= most, "bits out of range");
  }

  void state(Id id, const Node& node) {
    if (!require(id, node.high() < program_.phases.size(), "no such phase")) return;
    const Phase& phase = program_.phases[node.high()];
    if (!require(id, node.low() < phase.states.size(), "no such state")) return;
    const State& state = phase.states[node.low()];
    require(id, (node.op == Op::state ? state.id : state.result) == id, "not that of state '{}'", state.name);
  }

  void call(Id id, const Node& node) {
    if (!require(id, node.high() < program_.callees.size(), "no such callee")) return;
    const Program& callee = *program_.callees[node.high()];
    if (!require(id, node.low() < callee.outputs.size(), "'{}' has no such output", callee.name)) return;
    const Output& output = callee.outputs[node.low()];
    require(id, node.type == callee.graph[output.id].type, "not of the type of '{}.{}'", callee.name,
            output.name);
    if (!require(id, node.args.size() == callee.inputs.size(), "'{}' takes {} operands, not {}", callee.name,
                 callee.inputs.size(), node.args.size()))
      return;
    for (std::size_t i = 0; i < node.args.size(); ++i)
      require(id, graph_[node.args[i]].type == callee.inputs[i].type, "operand '{}' of '{}' is {}, not {}",
              callee.inputs[i].name, callee.name, to_text(callee.inputs[i].type),
              to_text(graph_[node.args[i]].type));
  }

  void operation(Id id, const Node& node) {
    std::vector<Type> types;
    for (const Id arg : node.args) types.push_back(graph_[arg].type);
    require(id, type_of(node.op, types) == node.type, "operands do not fit");
    if (!ok()) return;
    const std::string_view wrong = wrong_integers(graph_, node.op, node.args);
    require(id, wrong.empty(), "{}", wrong);
  }

  // Which phases a node sees: the one whose states it uses (from 1; 0: none), and the last one whose
  // results it uses. Two phases at once: `split`.
  struct Sees {
    std::size_t inside = 0, after = 0;
    bool split = false;
  };

  void uses() {
    std::vector<Sees> sees(graph_.size());
    for (std::uint32_t i = 0; i < sees.size(); ++i) {
      const Node node = graph_[Id{i}];
      if (node.op == Op::state) sees[i].inside = node.high() + 1;
      if (node.op == Op::result) sees[i].after = node.high() + 1;
      for (const Id arg : node.args) {
        const Sees& a = sees[arg.index];
        sees[i].split =
            sees[i].split || a.split || (a.inside > 0 && sees[i].inside > 0 && a.inside != sees[i].inside);
        sees[i].inside = std::max(sees[i].inside, a.inside);
        sees[i].after = std::max(sees[i].after, a.after);
      }
    }
    // `inside`: the phase whose states may be used, from 1; `after`: the last one whose results may.
    const auto use = [&](std::string what, Id id, Type type, std::size_t inside, std::size_t after) {
      if (!require(exists(id), "{} has no node", what)) return;
      const Sees& s = sees[id.index];
      require(graph_[id].type == type, "{} is {}, not {}", what, to_text(graph_[id].type), to_text(type));
      require(!s.split && (s.inside == 0 || s.inside == inside), "{} uses a state outside of its phase",
              what);
      require(s.after <= after, "{} uses the result of a phase before its end", what);
    };
    for (std::size_t p = 0; p < program_.phases.size(); ++p) {
      const Phase& phase = program_.phases[p];
      use(fmt::format("'enter' of phase '{}'", phase.name), phase.enter, truth, 0, p);
      use(fmt::format("'again' of phase '{}'", phase.name), phase.again, truth, p + 1, p);
      for (const State& state : phase.states) {
        use(fmt::format("the start of '{}.{}'", phase.name, state.name), state.init, state.type, 0, p);
        use(fmt::format("the next value of '{}.{}'", phase.name, state.name), state.next, state.type, p + 1,
            p);
      }
    }
    for (const Output& output : program_.outputs) {
      if (!require(exists(output.id), "output '{}' has no node", output.name)) return;
      const Type type = graph_[output.id].type;
      require(!type.is_table(), "output '{}' is a table", output.name);
      use(fmt::format("output '{}'", output.name), output.id, type, 0, program_.phases.size());
    }
  }

  const Program& program_;
  const Graph& graph_;
  std::string wrong_;
};

}  // namespace

std::string_view wrong_integers(const Graph& graph, Op op, std::span<const Id> args) {
  const auto is_integer = [&](std::size_t i, double least, double most) {
    const auto value = graph.number(args[i]);
    return value && least <= *value && *value <= most && *value == std::trunc(*value);
  };
  constexpr double limit = 1 << 20;
  if (op == Op::powi && !is_integer(1, -limit, limit))
    return "the exponent of 'powi' is a constant integer of magnitude at most 2^20";
  if (op != Op::chebyshev) return {};
  if (!is_integer(1, 0, largest_chebyshev_degree))
    return "the degree of 'chebyshev' is a constant integer from 0 to 2^20";
  if (!is_integer(2, 0, std::min(*graph.number(args[1]), largest_chebyshev_order)))
    return "the order of 'chebyshev' is a constant integer from 0 to the degree, and at most 8";
  return {};
}

std::string verify(const Program& program) { return Verifier(program).run(); }

}  // namespace imp
