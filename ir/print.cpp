// Programs as text (ir/text.h).
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <unordered_map>
#include <unordered_set>

#include "ir/regions.h"
#include "ir/spelling.h"
#include "ir/text.h"

namespace imp {
namespace {

// The name of every node within one Program, and the order in which operands are written.
class Names {
 public:
  Names(const Program& program, const std::vector<std::vector<Id>>& schedule)
      : graph_(program.graph), number_(graph_.size()) {
    for (const Input& input : program.inputs) give(input.id, spell_name(input.name));
    for (const Phase& phase : program.phases)
      for (const State& state : phase.states) {
        const std::string in_full = spell_name(phase.name) + '.' + spell_name(state.name);
        const bool is_an_input = program.input(state.name) != nullptr;
        give(state.id, is_an_input ? in_full : spell_name(state.name));
        give(state.result, in_full);
      }
    for (const auto& nodes : schedule)
      for (const Id id : nodes) give_node(id);
  }

  // %x, %bisect.t, %7, or the constant itself.
  std::string operator()(Id id) const {
    const Node node = graph_[id];
    if (node.op == Op::constant) return spell_constant(node);
    const auto it = name_.find(id);
    return it != name_.end() ? '%' + it->second : fmt::format("%{}", number_[id.index]);
  }

  // Where the order has no meaning: leaves, then nodes as they were printed, then constants. It does
  // not depend on ids, so that reading the text and printing it again gives the same text.
  std::vector<Id> operands(const Node& node) const {
    std::vector<Id> args(node.args.begin(), node.args.end());
    if (commutes(node.op)) std::ranges::sort(args, {}, [this](Id id) { return key(id); });
    return args;
  }

 private:
  using Key = std::array<std::uint64_t, 3>;

  Key key(Id id) const {
    const Node node = graph_[id];
    switch (node.op) {
      case Op::input:
      case Op::state:
      case Op::result:   return {0, static_cast<std::uint64_t>(node.op), node.payload};
      case Op::constant: return {2, node.payload, 0};
      default:           return {1, id.index, 0};
    }
  }

  void give(Id id, std::string name) {
    taken_.insert(name);
    name_.insert_or_assign(id, std::move(name));
  }

  void give_node(Id id) {
    const std::string_view wanted = graph_.name(id);
    if (wanted.empty()) {
      number_[id.index] = ++last_number_;
      return;
    }
    std::string name = spell_name(wanted);
    for (unsigned& tries = tries_[std::string(wanted)]; taken_.contains(name);)
      name = spell_name(fmt::format("{}_{}", wanted, ++tries + 1));
    give(id, std::move(name));
  }

  const Graph& graph_;
  std::vector<std::uint32_t> number_;  // of nodes without a name
  std::uint32_t last_number_ = 0;
  std::unordered_map<Id, std::string> name_;
  std::unordered_set<std::string> taken_;
  std::unordered_map<std::string, unsigned> tries_;
};

class Printer {
 public:
  std::string text;

  void callees(const Program& program) {
    for (const auto& callee : program.callees) {
      if (labels_.contains(callee.get())) continue;
      callees(*callee);
      const unsigned count = ++called_[callee->name];
      std::string label = spell_name(callee->name);
      if (count > 1) label += fmt::format("@{}", count);
      labels_.emplace(callee.get(), std::move(label));
      print(*callee);
    }
  }

  void stage(const Stage& stage) {
    callees(stage.program);
    separate();
    line("stage {} {} {}", stage.cells[0], stage.cells[1], stage.cells[2]);
    print(stage.program, false);
  }

  void print(const Program& whole, bool apart = true) {
    const Program program = compact(whole);
    const auto nodes = schedule(program);
    const Names names(program, nodes);

    if (apart) separate();
    line("program {}", spell_name(program.name));
    indent_ = 2;
    header(program);
    shared(program, nodes, names);
    for (std::size_t i = 0; i < program.phases.size(); ++i) {
      phase(program, i, nodes[Region::in_phase(i).rank], names);
      separate_if(!nodes[Region::after_phase(i).rank].empty());
      statements(program, nodes[Region::after_phase(i).rank], names);
    }
    separate_if(!program.outputs.empty());
    for (const Output& output : program.outputs)
      line("output {} = {}", spell_name(output.name), names(output.id));
    indent_ = 0;
    line("end");
  }

 private:
  template <class... Args>
  void line(fmt::format_string<Args...> form, Args&&... args) {
    text.append(indent_, ' ');
    fmt::format_to(std::back_inserter(text), form, std::forward<Args>(args)...);
    text += '\n';
  }

  void separate() { separate_if(!text.empty()); }
  void separate_if(bool wanted) {
    if (wanted) text += '\n';
  }

  void header(const Program& program) {
    if (!program.callees.empty()) {
      std::string list;
      for (const auto& callee : program.callees)
        list += (list.empty() ? "" : ", ") + labels_.at(callee.get());
      line("calls {}", list);
    }
    static constexpr std::array rates{"frame", "cell", "ray"};
    for (const Input& input : program.inputs)
      line("input {} {}: {}", rates[static_cast<std::size_t>(input.rate)], spell_name(input.name),
           to_text(input.type));
  }

  // What comes before the phases, by how often it is computed; said only where there is a difference.
  void shared(const Program& program, const std::vector<std::vector<Id>>& nodes, const Names& names) {
    static constexpr std::array titles{"once", "once a frame", "once a cell", "once a ray"};
    const auto ray = Region::of(Rate::ray).rank;
    bool only_in_ray = true;
    for (std::uint32_t rank = 0; rank < ray; ++rank) only_in_ray = only_in_ray && nodes[rank].empty();
    for (std::uint32_t rank = 0; rank <= ray; ++rank) {
      if (nodes[rank].empty()) continue;
      separate();
      if (!only_in_ray) line("# {}", titles[rank]);
      statements(program, nodes[rank], names);
    }
  }

  void phase(const Program& program, std::size_t i, const std::vector<Id>& nodes, const Names& names) {
    const Phase& phase = program.phases[i];
    separate();
    line("phase {} {}", spell_name(phase.name), phase.steps);
    indent_ = 4;
    if (program.graph.truth_value(phase.enter) != true) line("enter {}", names(phase.enter));
    for (const State& state : phase.states)
      line("state {}: {} = {}", spell_name(state.name), to_text(state.type), names(state.init));
    statements(program, nodes, names);
    for (const State& state : phase.states)
      if (state.next != state.id) line("next {} = {}", spell_name(state.name), names(state.next));
    line("again {}", names(phase.again));
    indent_ = 2;
    line("end");
  }

  void statements(const Program& program, const std::vector<Id>& nodes, const Names& names) {
    for (const Id id : nodes) {
      const Node node = program.graph[id];
      std::string right(info(node.op).name);
      if (node.op == Op::fill) right += ' ' + to_text(node.type);
      if (node.op == Op::call) {
        const Program& callee = *program.callees[node.high()];
        right += ' ' + labels_.at(&callee) + '.' + spell_name(callee.outputs[node.low()].name);
      }
      for (const Id arg : names.operands(node)) right += ' ' + names(arg);
      line("{} = {}", names(id), right);
    }
  }

  std::size_t indent_ = 0;
  std::unordered_map<const Program*, std::string> labels_;  // of callees already printed
  std::unordered_map<std::string, unsigned> called_;        // how many of them have a name
};

}  // namespace

std::string to_text(const Program& program) {
  Printer printer;
  printer.callees(program);
  printer.print(program);
  return std::move(printer.text);
}

std::string to_text(const Pipeline& pipeline) {
  Printer printer;
  for (const Stage& stage : pipeline) printer.stage(stage);
  return std::move(printer.text);
}

}  // namespace imp
