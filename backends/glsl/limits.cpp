#include "backends/glsl/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "ir/regions.h"

namespace imp {
namespace {

// A driver's compiler takes about the square of their number, 10 s here (docs/decisions/glsl.md). It sees what an
// upward op is spelled with.
constexpr std::uint64_t most_operations = 15'000;
constexpr std::uint64_t operations_of_upward_op = 11;
// llvmpipe leaves all loops of a shader, without a word, after 65535 steps in all.
constexpr std::uint64_t most_steps = 65535;
constexpr std::uint32_t longest_table = 1024;
constexpr std::size_t most_inputs = 1000;  // of which the time of a driver's compiler takes the square

constexpr std::uint64_t many = std::uint64_t{1} << 31;  // of it 2^32 times are still a number

// Functions become part of where they are called, so both are counted once a call.
struct Count {
  std::uint64_t operations = 0, steps = 0;
};

std::optional<Refusal> refusal_of_node(const Program& program, Id id) {
  const Node node = program.graph[id];
  const OpInfo& op = info(node.op);
  const auto refuse = [&](std::string why) { return Refusal{std::move(why), program.graph.span(id)}; };
  if (node.type.length > longest_table)
    return refuse(fmt::format("a table of {} values is too long for a shader; {} is the most",
                              node.type.length, longest_table));
  if (node.op == Op::powi) return refuse("'powi' has no shader form: the power pass must expand it first");
  if (op.kind != OpKind::structure && op.glsl.empty())
    return refuse(fmt::format("'{}' has no shader form yet; use --backend=interpreter", op.name));
  return std::nullopt;
}

std::optional<Refusal> count(const Program& program, Count& total) {
  const auto nodes = schedule(program);
  std::set<std::pair<std::uint32_t, std::vector<Id>>> calls;
  for (std::size_t rank = 0; rank < nodes.size(); ++rank) {
    const Region region{static_cast<std::uint32_t>(rank)};
    const std::size_t phase =
        region.inside_a_phase() ? (rank - Region::in_phase(0).rank) / 2 : program.phases.size();
    const bool repeated = phase < program.phases.size();
    const std::uint64_t times = repeated ? program.phases[phase].steps : 1;
    if (repeated) total.steps = std::min(many, total.steps + times);
    for (const Id id : nodes[rank]) {
      if (auto why = refusal_of_node(program, id)) return why;
      const Node node = program.graph[id];
      total.operations += rounds_up(node.op) ? operations_of_upward_op : 1;
      if (node.op != Op::call ||
          !calls.emplace(node.high(), std::vector(node.args.begin(), node.args.end())).second)
        continue;
      Count callee;
      if (auto why = count(*program.callees[node.high()], callee)) return why;
      total.operations = std::min(many, total.operations + callee.operations);
      total.steps = std::min(many, total.steps + times * callee.steps);
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<Refusal> glsl_refusal(const Program& program) {
  if (program.inputs.size() > most_inputs)
    return Refusal{fmt::format("this has {} inputs, and a shader has at most {}; use --backend=llvm",
                               program.inputs.size(), most_inputs)};
  Count total;
  if (auto why = count(program, total)) return why;
  if (total.operations > most_operations)
    return Refusal{fmt::format("this takes {} operations, and a shader has at most {}; use --backend=llvm",
                               total.operations, most_operations)};
  if (total.steps > most_steps)
    return Refusal{fmt::format("this takes up to {} steps, and a shader makes at most {}; use --backend=llvm",
                               total.steps, most_steps)};
  return std::nullopt;
}

}  // namespace imp
