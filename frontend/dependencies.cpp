#include "frontend/dependencies.h"

#include <fmt/format.h>

#include "frontend/lexer.h"

namespace imp::syntax {
namespace {

constexpr std::uint32_t coordinates = 3;  // the first inputs of a surface

struct Needs {
  bool point = false;    // x, y or z
  bool uniform = false;  // a parameter or the time

  void add(Needs other) {
    point |= other.point;
    uniform |= other.uniform;
  }
};

bool refers(const Node& node) { return node.kind == NodeKind::definition || node.kind == NodeKind::call; }

class Dependencies {
 public:
  Dependencies(const Ast& ast, Diagnostics& diagnostics)
      : ast_(ast), diagnostics_(diagnostics), state_(ast.definitions.size()), needs_(ast.definitions.size()) {
    for (std::uint32_t i = 0; i < ast.definitions.size(); ++i)
      if (state_[i] == State::unseen) visit(i);
  }

  void check(const Number& number) const {
    for (std::uint32_t i = number.value.begin; i < number.value.end; ++i) {
      const Node& node = ast_.nodes[i];
      const Needs needs = of(node);
      if (!needs.point && !(needs.uniform && number.constant)) continue;
      const Span span = ast_.span(node);
      const std::string name =
          quoted(diagnostics_.sources.text(ast_.file).substr(node.begin, node.end - node.begin));
      const std::string_view depends = node.kind == NodeKind::input ? "is" : "depends on";
      if (needs.point)
        diagnostics_.error(
            span, fmt::format("{} {} a coordinate, which has a value in surfaces only", name, depends));
      else
        diagnostics_.error(
            span, fmt::format("{} {} a parameter or the time; a default or a range must be constant", name,
                              depends));
      return;
    }
  }

 private:
  enum class State : std::uint8_t { unseen, open, done };

  // Depth first, on a stack of our own: definitions may form a chain as long as the file.
  void visit(std::uint32_t first) {
    struct Open {
      std::uint32_t definition, at;
    };
    std::vector<Open> stack;
    const auto enter = [&](std::uint32_t definition) {
      state_[definition] = State::open;
      stack.push_back({definition, ast_.definitions[definition].body.begin});
    };
    enter(first);
    while (!stack.empty()) {
      Open& top = stack.back();
      if (top.at == ast_.definitions[top.definition].body.end) {
        const std::uint32_t finished = top.definition;
        state_[finished] = State::done;
        stack.pop_back();
        if (!stack.empty()) needs_[stack.back().definition].add(needs_[finished]);
        continue;
      }
      const Node& node = ast_.nodes[top.at++];
      if (refers(node) && state_[node.index] == State::unseen)
        enter(node.index);
      else if (refers(node) && state_[node.index] == State::open)
        report_cycle(node);
      else
        needs_[top.definition].add(of(node));
    }
  }

  Needs of(const Node& node) const {
    if (node.kind == NodeKind::input) return {node.index < coordinates, node.index >= coordinates};
    return refers(node) ? needs_[node.index] : Needs{};
  }

  void report_cycle(const Node& node) const {
    const Definition& definition = ast_.definitions[node.index];
    diagnostics_.error(ast_.span(node), quoted(definition.name) + " is defined in terms of itself");
    diagnostics_.note(definition.span, "defined here");
  }

  const Ast& ast_;
  Diagnostics& diagnostics_;
  std::vector<State> state_;
  std::vector<Needs> needs_;
};

}  // namespace

void check_dependencies(const Ast& ast, Diagnostics& diagnostics) {
  const Dependencies dependencies(ast, diagnostics);
  for (const Number& number : ast.settings) dependencies.check(number);
}

}  // namespace imp::syntax
