#include "backends/glsl/emit.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "backends/glsl/layout.h"
#include "backends/glsl/limits.h"
#include "backends/glsl/names.h"
#include "backends/glsl/prelude.h"
#include "ir/assert.h"
#include "ir/regions.h"

namespace imp {
namespace {

std::string_view name_of(Type type) {
  return type.scalar == Scalar::truth ? "bool" : type.scalar == Scalar::f32 ? "float" : "double";
}

// "precise float name[3]": precise keeps the compiler from rewriting what rounds.
std::string declaration(Type type, std::string_view name) {
  return fmt::format("{}{} {}{}", type.scalar == Scalar::truth ? "" : "precise ", name_of(type), name,
                     type.is_table() ? fmt::format("[{}]", type.length) : "");
}

// A constant, exactly. Zeros hide in a uniform, see backends/glsl/prelude.h.
std::string literal(const Node& constant) {
  if (constant.type.is_truth()) return constant.payload != 0 ? "true" : "false";
  const bool is_float = constant.type == f32;
  const auto bits32 = static_cast<std::uint32_t>(constant.payload);
  const double value = is_float ? std::bit_cast<float>(bits32) : std::bit_cast<double>(constant.payload);
  const auto with_sign = [&](const std::string& text) {
    return std::signbit(value) ? "(-" + text + ")" : text;
  };
  if (value == 0) return with_sign(is_float ? "zero" : "zero_f64");
  if (!std::isfinite(value))
    return is_float ? fmt::format("uintBitsToFloat({:#x}u)", bits32)
                    : fmt::format("packDouble2x32(uvec2({:#x}u, {:#x}u))", bits32, constant.payload >> 32);
  std::string digits = is_float ? fmt::format("{}", std::abs(std::bit_cast<float>(bits32)))
                                : fmt::format("{}", std::abs(value));
  if (digits.find_first_of(".e") == std::string::npos) digits += ".0";
  if (!is_float) digits += "lf";
  return with_sign(digits);
}

// `text` without the parentheses around all of it.
std::string bare(std::string text) {
  if (!text.starts_with('(')) return text;
  int depth = 0;
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    depth += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
    if (depth == 0) return text;
  }
  return text.substr(1, text.size() - 2);
}

// "a + b" of "($a + $b)".
std::string spell(std::string_view spelling, std::span<const std::string> operands) {
  std::string text;
  for (std::size_t i = 0; i < spelling.size(); ++i) {
    if (spelling[i] == '$')
      text += operands[static_cast<std::size_t>(spelling[++i] - 'a')];
    else
      text += spelling[i];
  }
  return bare(std::move(text));
}

// What all functions of one shader share.
struct Shader {
  Names names;  // of the functions and of all that is global; a function adds its own to a copy
  std::map<const Program*, std::string> functions;
  Helpers helpers;
  std::string text;  // of the functions
};

// One function of the shader: the statements of a Program.
class Body {
 public:
  Body(Shader& shader, const Program& program)
      : shader_(shader), program_(program), schedule_(schedule(program)), values_(program.graph.size()) {
    for (const auto& callee : program.callees) function(*callee);
    names_ = shader.names;
  }

  std::string kernel();

 private:
  void function(const Program& callee);
  void statements();
  void phase(std::size_t number);
  void compute(Region region, std::string_view comment);
  void compute(Id id);
  void call(Id id, const Node& node);
  std::string place(Id table, Id index);
  void read_inputs(const Layout& layout);
  bool only_loaded(Id table) const;

  const std::string& value(Id id) {
    const Node node = program_.graph[id];
    std::string& known = values_[id.index];
    if (known.empty() && node.op == Op::constant) known = literal(node);
    IMP_ASSERT(!known.empty(), "a node whose operands were computed before it");
    return known;
  }
  // The name of a new variable for `id`.
  const std::string& name(Id id, std::string_view given) {
    return values_[id.index] = names_.take(given.empty() ? fmt::format("v{}", ++unnamed_) : given);
  }
  void line(std::string_view text) { text_ += fmt::format("{:{}}{}\n", "", indent_, text); }
  // Whatever the user's names hold, the comment ends with its line.
  void comment(std::string text) {
    std::ranges::replace_if(text, [](char c) { return c < ' ' || c > '~' || c == '\\'; }, '_');
    text_ += '\n';
    line("// " + text);
  }
  void helper(std::string_view name, Type type) { shader_.helpers.emplace(name, type.scalar); }

  Shader& shader_;
  const Program& program_;
  std::vector<std::vector<Id>> schedule_;
  Names names_;
  std::vector<std::string> values_;                 // how a node is referred to
  std::unordered_map<Id, std::uint32_t> in_cells_;  // tables that are read where they are given
  std::map<std::pair<std::uint32_t, std::vector<Id>>, std::vector<std::string>> calls_;  // their results
  std::string text_;
  std::size_t indent_ = 2, unnamed_ = 0;
};

bool Body::only_loaded(Id table) const {
  const Graph& graph = program_.graph;
  for (const auto& nodes : schedule_)
    for (const Id id : nodes)
      if (const Node node = graph[id]; std::ranges::find(node.args, table) != node.args.end())
        if (node.op != Op::load) return false;
  return std::ranges::none_of(program_.phases, [&](const Phase& phase) {
    return std::ranges::any_of(phase.states,
                               [&](const State& s) { return s.init == table || s.next == table; });
  });
}

// An element of a buffer, `at` words from its start.
std::string read(Type type, std::string_view buffer, const std::string& at) {
  if (type.scalar == Scalar::truth) return fmt::format("{}[{}] != 0u", buffer, at);
  if (type.scalar == Scalar::f32) return fmt::format("uintBitsToFloat({}[{}])", buffer, at);
  return fmt::format("packDouble2x32(uvec2({0}[{1}], {0}[{1} + 1u]))", buffer, at);
}

// The first word of a ray's value in the columns of a buffer.
std::string in_column(Type type, std::uint32_t slot) {
  return fmt::format("{}u * size + {}ray", slot, type.scalar == Scalar::f64 ? "2u * " : "");
}

void Body::read_inputs(const Layout& layout) {
  for (std::size_t i = 0; i < program_.inputs.size(); ++i) {
    const Input& input = program_.inputs[i];
    const std::uint32_t at = layout.inputs[i];
    if (input.type.is_table() && only_loaded(input.id)) {
      in_cells_[input.id] = at;
      continue;
    }
    const std::string& variable = name(input.id, input.name);
    if (input.type.is_table()) {
      line(declaration(input.type, variable) + ";");
      const std::string step = input.type.scalar == Scalar::f64 ? "2u * " : "";
      line(fmt::format("for (int i = 0; i < {}; ++i) {}[i] = {};", input.type.length, variable,
                       read(input.type, "cells", fmt::format("{}u + {}uint(i)", at, step))));
      continue;
    }
    const bool own = input.rate == Rate::ray;
    line(fmt::format(
        "{} = {};", declaration(input.type, variable),
        read(input.type, own ? "rays" : "cells", own ? in_column(input.type, at) : fmt::format("{}u", at))));
  }
}

std::string Body::kernel() {
  const Layout layout(program_);
  line("uint ray = gl_GlobalInvocationID.x;");
  line("if (ray >= size) return;");
  read_inputs(layout);
  statements();
  for (std::size_t i = 0; i < program_.outputs.size(); ++i) {
    const Output& output = program_.outputs[i];
    const Type type = program_.graph[output.id].type;
    const std::string at = in_column(type, layout.outputs[i]), &result = value(output.id);
    comment(output.name);
    if (type.is_truth()) line(fmt::format("results[{}] = {} ? 1u : 0u;", at, result));
    if (type == f32) line(fmt::format("results[{}] = floatBitsToUint({});", at, result));
    if (type == f64) {
      const std::string bits = fmt::format("unpackDouble2x32({})", result);
      line(fmt::format("results[{}] = {}.x;", at, bits));
      line(fmt::format("results[{} + 1u] = {}.y;", at, bits));
    }
  }
  return "void main() {\n" + text_ + "}\n";
}

void Body::function(const Program& callee) {
  if (shader_.functions.contains(&callee)) return;
  Body body(shader_, callee);
  const std::string& called = shader_.functions[&callee] = shader_.names.take(callee.name);
  body.names_.take(called);
  std::string parameters;
  const auto parameter = [&](const std::string& text) {
    parameters += (parameters.empty() ? "" : ", ") + text;
  };
  for (const Input& input : callee.inputs)
    parameter(fmt::format("{} {}{}", name_of(input.type), body.name(input.id, input.name),
                          input.type.is_table() ? fmt::format("[{}]", input.type.length) : ""));
  std::vector<std::string> results;
  for (const Output& output : callee.outputs) {
    results.push_back(body.names_.take(output.name));
    parameter(fmt::format("out {} {}", name_of(callee.graph[output.id].type), results.back()));
  }
  body.statements();
  for (std::size_t i = 0; i < results.size(); ++i)
    body.line(fmt::format("{} = {};", results[i], body.value(callee.outputs[i].id)));
  shader_.text += fmt::format("void {}({}) {{\n{}}}\n\n", called, parameters, body.text_);
}

void Body::statements() {
  compute(Region::constant(), "constants");
  compute(Region::of(Rate::frame), "the same for all rays");
  compute(Region::of(Rate::cell), "the same for all rays of a cell");
  compute(Region::of(Rate::ray), "of the ray");
  for (std::size_t i = 0; i < program_.phases.size(); ++i) {
    phase(i);
    compute(Region::after_phase(i), fmt::format("after {}", program_.phases[i].name));
  }
}

void Body::compute(Region region, std::string_view comment) {
  const auto& nodes = schedule_[region.rank];
  if (nodes.empty()) return;
  if (!comment.empty()) { this->comment(std::string(comment)); }
  for (const Id id : nodes) compute(id);
}

std::string Body::place(Id table, Id index) {
  const Type type = program_.graph[table].type;
  if (const auto number = program_.graph.number(index))
    return fmt::format(
        "{}", *number > 0 ? static_cast<std::uint32_t>(std::min<double>(*number, type.length - 1)) : 0u);
  helper("element", program_.graph[index].type);
  return fmt::format("element({}, {})", value(index), type.length);
}

void Body::compute(Id id) {
  const Node node = program_.graph[id];
  const std::string_view given = program_.graph.name(id);
  switch (node.op) {
    case Op::call: return call(id, node);
    case Op::fill: {
      const std::string& first = value(node.args[0]);
      const std::string& table = name(id, given);
      line(declaration(node.type, table) + ";");
      line(fmt::format("for (int i = 0; i < {}; ++i) {}[i] = {};", node.type.length, table, first));
      return;
    }
    case Op::store: {
      const std::string at = place(node.args[0], node.args[1]);
      const std::string& table = name(id, given);
      line(fmt::format("{} = {};", declaration(node.type, table), value(node.args[0])));
      line(fmt::format("{}[{}] = {};", table, at, value(node.args[2])));
      return;
    }
    case Op::load: {
      std::string at = place(node.args[0], node.args[1]);
      std::string element;
      if (const auto it = in_cells_.find(node.args[0]); it != in_cells_.end()) {
        const std::string step = node.type.scalar == Scalar::f64 ? "2u * " : "";
        element = read(node.type, "cells", fmt::format("{}u + {}uint({})", it->second, step, at));
      } else {
        element = fmt::format("{}[{}]", value(node.args[0]), at);
      }
      line(fmt::format("{} = {};", declaration(node.type, name(id, given)), element));
      return;
    }
    default: {
      std::vector<std::string> operands;
      for (const Id arg : node.args) operands.push_back(value(arg));
      const std::string_view spelling = info(node.op).glsl;
      for (const std::string_view called : helpers_in(spelling))
        helper(called, program_.graph[node.args[0]].type);
      line(fmt::format("{} = {};", declaration(node.type, name(id, given)), spell(spelling, operands)));
    }
  }
}

void Body::call(Id id, const Node& node) {
  const Program& callee = *program_.callees[node.high()];
  auto& results = calls_[{node.high(), {node.args.begin(), node.args.end()}}];
  if (results.empty()) {
    std::string arguments;
    for (const Id arg : node.args) arguments += (arguments.empty() ? "" : ", ") + bare(value(arg));
    for (const Output& output : callee.outputs) {
      results.push_back(names_.take(output.name));
      line(declaration(callee.graph[output.id].type, results.back()) + ";");
      arguments += (arguments.empty() ? "" : ", ") + results.back();
    }
    line(fmt::format("{}({});", shader_.functions.at(&callee), arguments));
  }
  values_[id.index] = results[node.low()];
}

// All states change at once: what the next value of one is, and whether to go on, is of the states before.
void Body::phase(std::size_t number) {
  const Phase& phase = program_.phases[number];
  comment(fmt::format("{}: at most {} steps", phase.name, phase.steps));
  std::vector<std::string> states;
  for (const State& state : phase.states) {
    const std::string init = value(state.init);
    states.push_back(name(state.id, state.name));
    line(fmt::format("{} = {};", declaration(state.type, states.back()), bare(init)));
  }
  const std::string again = names_.take("again"), step = names_.take("step");
  line(fmt::format("bool {} = {};", again, bare(value(phase.enter))));
  line(fmt::format("for (int {0} = 0; {1} && {0} < {2}; ++{0}) {{", step, again, phase.steps));
  indent_ += 2;
  compute(Region::in_phase(number), "");
  line(fmt::format("{} = {};", again, bare(value(phase.again))));
  std::vector<std::pair<std::string, std::string>> moves;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const State& state = phase.states[i];
    if (state.next == state.id) continue;
    std::string next = bare(value(state.next));
    const Node node = program_.graph[state.next];
    if (node.op == Op::state && node.high() == number) {
      const std::string before = names_.take(next + "_before");
      line(fmt::format("{} = {};", declaration(state.type, before), next));
      next = before;
    }
    moves.emplace_back(states[i], next);
  }
  for (const auto& [to, from] : moves) line(fmt::format("{} = {};", to, from));
  indent_ -= 2;
  line("}");
  for (std::size_t i = 0; i < states.size(); ++i) values_[phase.states[i].result.index] = states[i];
}

constexpr std::string_view head = R"(#version 450
layout(local_size_x = {}) in;
layout(std430, binding = 0) readonly buffer Cells {{ uint cells[]; }};
layout(std430, binding = 1) readonly buffer Rays {{ uint rays[]; }};
layout(std430, binding = 2) writeonly buffer Results {{ uint results[]; }};
uniform uint size;  // rays
uniform float zero;  // hidden from the compiler, which would fold x * 0
uniform double zero_f64;

)";

}  // namespace

std::expected<std::string, Refusal> emit_glsl(const Program& program) {
  if (auto why = glsl_refusal(program)) return std::unexpected(*std::move(why));
  Shader shader;
  for (const std::string_view taken : {"cells", "rays", "results", "size", "ray", "zero", "zero_f64", "i"})
    shader.names.take(taken);
  for (const std::string_view taken : helper_names()) shader.names.take(taken);

  const std::string main = Body(shader, program).kernel();
  const std::string functions = prelude(shader.helpers) + shader.text;
  return fmt::format(head, group_size) + functions + main;
}

}  // namespace imp
