#include "frontend/model.h"

#include <fmt/format.h>

#include "frontend/dependencies.h"
#include "frontend/lower.h"
#include "frontend/parser.h"

namespace imp {
namespace {

constexpr std::size_t largest_file = std::size_t{64} << 20;
// Passes and derivatives of a longer formula take seconds, and no kernel could be made of it (docs/guarantees.md,
// "Sizes").
constexpr std::size_t longest_formula = 30'000;
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

// The inputs of a surface: x, y, z, the parameters, the time. Outside the surfaces there is no point.
std::vector<Id> add_inputs(Program& program, const Model& model, bool point) {
  std::vector<Id> inputs;
  for (const char* name : {"x", "y", "z"})
    inputs.push_back(point ? add_input(program, name, f64, Rate::ray) : Id{});
  for (const Parameter& parameter : model.parameters)
    inputs.push_back(add_input(program, parameter.name, f64, Rate::frame));
  if (model.time) inputs.push_back(add_input(program, model.time->name, f64, Rate::frame));
  return inputs;
}

std::size_t operations(const Graph& graph) {
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < graph.size(); ++i) count += graph[Id{i}].args.empty() ? 0 : 1;
  return count;
}

// Makes the Programs of a Model.
class Builder {
 public:
  Builder(const syntax::Ast& ast, Model& model, Diagnostics& diagnostics)
      : ast_(ast), model_(model), diagnostics_(diagnostics) {}

  void surface(const syntax::Equation& equation) {
    if (!pay_for_inputs(equation.span)) return;
    Program program;
    program.name = equation.name;
    syntax::Lowering lower(ast_, program.graph, add_inputs(program, model_, true), budget_, diagnostics_);
    const auto left = lower(equation.left, equation.span);
    if (!left) return;
    Id f = *left;
    if (equation.right.size() > 0) {
      const auto right = lower(equation.right, equation.span);
      if (!right) return;
      if (program.graph.number(*right) != 0) f = program.graph.add(Op::sub, {f, *right});
      program.graph.set_span(f, equation.span);
    }
    if (const std::size_t count = operations(program.graph); count > longest_formula)
      return diagnostics_.error(equation.span,
                                fmt::format("this takes {} operations, and a formula has at most {}; "
                                            "let fewer terms or a shorter sum stand for it",
                                            count, longest_formula));
    program.outputs.push_back({"f", f});
    model_.surfaces.push_back({equation.name, std::move(program), equation.span});
  }

  void settings() {
    model_.settings.name = "settings";
    syntax::Lowering lower(ast_, model_.settings.graph, add_inputs(model_.settings, model_, false), budget_,
                           diagnostics_);
    for (const syntax::Number& number : ast_.settings) {
      const syntax::Node& first = ast_.nodes[number.value.begin];
      if (const auto value = lower(number.value, ast_.span(first)))
        model_.settings.outputs.push_back({number.name, *value});
    }
  }

 private:
  // Every surface has an input for every parameter.
  bool pay_for_inputs(Span place) {
    const bool enough = model_.parameters.size() <= budget_;
    if (enough) budget_ -= model_.parameters.size();
    if (!enough) diagnostics_.error(place, "too many surfaces of too many parameters");
    return enough;
  }

  const syntax::Ast& ast_;
  Model& model_;
  Diagnostics& diagnostics_;
  std::size_t budget_ = syntax::most_operations;
};

}  // namespace

std::optional<Model> parse_model(std::string text, std::string name, Diagnostics& diagnostics) {
  if (text.size() > largest_file) {
    diagnostics.error(fmt::format("{} is larger than {} MiB", name, largest_file >> 20));
    return std::nullopt;
  }
  if (text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
  const std::size_t before = diagnostics.errors();
  const std::uint32_t file = diagnostics.sources.add(std::move(name), std::move(text));
  const std::string_view source = diagnostics.sources.text(file);

  syntax::Ast ast;
  ast.file = file;
  Model model;
  {
    const std::vector<syntax::Statement> statements = syntax::split(source);
    const syntax::Symbols symbols(statements, source, file);
    syntax::Parser(symbols, ast, model, diagnostics).file(statements);
  }
  syntax::check_dependencies(ast, diagnostics);
  if (ast.surfaces.empty() && diagnostics.errors() == before) {
    const auto end = static_cast<std::uint32_t>(source.size());
    diagnostics.error({file, end, end},
                      "the file has no surface; write an equation, such as x^2 + y^2 + z^2 = 1");
  }
  if (diagnostics.errors() > before) return std::nullopt;

  Builder builder(ast, model, diagnostics);
  for (const syntax::Equation& equation : ast.surfaces) builder.surface(equation);
  builder.settings();
  return diagnostics.errors() > before ? std::nullopt : std::optional(std::move(model));
}

}  // namespace imp
