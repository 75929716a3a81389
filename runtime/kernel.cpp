#include "runtime/kernel.h"

#include <bit>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "backends/glsl/kernel.h"
#include "backends/llvm/compile.h"
#include "ir/assert.h"
#include "passes/rewrite.h"
#include "passes/round_to_nearest.h"
#include "passes/surface_passes.h"

namespace imp {
namespace {

constexpr Pass to_nearest{"round-to-nearest", Preserves::value, round_to_nearest};

std::expected<std::unique_ptr<Kernel>, Refusal> compile_for_cpu(const Program& program,
                                                                const std::string& name, Timings* timings) {
  const auto target = cpu_target(name);
  if (!target) {
    std::string known;
    for (const CpuTarget& each : cpu_targets()) known += (known.empty() ? "" : ", ") + each.name;
    return std::unexpected(Refusal{"unknown target '" + name + "'; there are: " + known});
  }
  CompileTimes times;
  auto kernel = compile(program, *target, &times);
  if (timings)
    timings->entries.insert(timings->entries.end(),
                            {{"build code", times.build}, {"generate code", times.codegen}});
  return kernel;
}

std::expected<std::unique_ptr<Kernel>, Refusal> compile_for_gl(Program program, Timings* timings) {
  return timed(timings, "compile shader", [&] { return compile_glsl(std::move(program)); });
}

// Passes shorten a Program by half at most: what is added up and down may be one when rounding to nearest.
constexpr std::size_t longest_for_passes = 2 * 20'000;
constexpr std::size_t longest_for_interpreter = 2 * 100'000;

// What the ops are at least when they are lowered.
std::size_t least_operations(const Program& program) {
  constexpr std::size_t of_elementary = 8;
  const Graph& graph = program.graph;
  const std::vector<bool> live = live_nodes(program);
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < live.size(); ++i) {
    const Node node = graph[Id{i}];
    const OpKind kind = info(node.op).kind;
    if (!live[i] || kind == OpKind::structure) continue;
    if (node.op == Op::powi || node.op == Op::chebyshev)
      count += std::bit_width(static_cast<std::uint32_t>(std::abs(*graph.number(node.args[1]))));
    else
      count += kind == OpKind::elementary ? of_elementary : 1;
  }
  return count;
}

std::optional<Refusal> refusal_of(std::size_t operations, const KernelOptions& options) {
  const bool interpreted = options.backend == Backend::interpreter;
  const std::size_t most = interpreted ? longest_for_interpreter : longest_for_passes;
  if (operations <= most) return std::nullopt;
  return Refusal{
      fmt::format("this takes at least {} operations, and at most {} can be run; {}a shorter formula is "
                  "needed",
                  operations / 2, most / 2, interpreted ? "" : "--backend=interpreter or ")};
}

}  // namespace

std::optional<Refusal> far_too_long(const Program& program, const KernelOptions& options) {
  return refusal_of(least_operations(program), options);
}

std::optional<Refusal> far_too_long_to_search(const Program& f, const KernelOptions& options) {
  constexpr std::size_t times = 4;  // two ends of f, two of a derivative
  return refusal_of(times * least_operations(f), options);
}

std::vector<Pass> passes_for(const KernelOptions& options) {
  std::vector<Pass> passes;
  if (!options.outward) passes.push_back(to_nearest);
  passes.insert(passes.end(), kernel_passes().begin(), kernel_passes().end());
  return passes;
}

std::vector<Pass> all_passes() {
  std::vector<Pass> passes(surface_passes().begin(), surface_passes().end());
  const auto of_kernels = passes_for({.outward = false});
  passes.insert(passes.end(), of_kernels.begin(), of_kernels.end());
  return passes;
}

Program lower(Program program, const KernelOptions& options, PassTrace* trace) {
  return run_passes(std::move(program), passes_for(options), trace);
}

std::expected<std::unique_ptr<Kernel>, Refusal> make_kernel(Program program, const KernelOptions& options,
                                                            Timings* timings) {
  if (auto why = far_too_long(program, options)) return std::unexpected(*std::move(why));
  program = timed(timings, "passes", [&] { return lower(std::move(program), options); });
  return make_lowered_kernel(std::move(program), options, timings);
}

std::expected<std::unique_ptr<Kernel>, Refusal> make_lowered_kernel(Program program,
                                                                    const KernelOptions& options,
                                                                    Timings* timings) {
  switch (options.backend) {
    case Backend::llvm:        return compile_for_cpu(program, options.target, timings);
    case Backend::glsl:        return compile_for_gl(std::move(program), timings);
    case Backend::interpreter: return interpret(std::move(program));
  }
  return std::unexpected(Refusal{"unknown backend"});
}

std::vector<Column> run_rows(const Kernel& kernel, std::span<const Column> inputs, std::size_t rows) {
  const Program& program = kernel.program();
  IMP_ASSERT(inputs.size() == program.inputs.size(), "a column for every input");

  std::vector<Column> spread;  // single values, over all rows
  spread.reserve(inputs.size());
  std::vector<const void*> in;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    IMP_ASSERT(program.inputs[i].type == f64, "inputs of type f64");
    const bool single = inputs[i].size() == 1 && program.inputs[i].rate == Rate::ray;
    in.push_back(single ? spread.emplace_back(rows, inputs[i][0]).data() : inputs[i].data());
  }

  std::vector<Column> results;
  std::vector<std::vector<unsigned char>> truths(program.outputs.size());
  std::vector<void*> out;
  for (std::size_t i = 0; i < program.outputs.size(); ++i) {
    const Type type = program.graph[program.outputs[i].id].type;
    IMP_ASSERT(type == f64 || type == truth, "outputs of type f64 or truth");
    results.emplace_back(rows);
    if (type == truth) truths[i].resize(rows);
    out.push_back(type == truth ? static_cast<void*>(truths[i].data()) : results[i].data());
  }

  kernel.run({rows, in, out});
  for (std::size_t i = 0; i < truths.size(); ++i)
    for (std::size_t row = 0; row < truths[i].size(); ++row) results[i][row] = truths[i][row];
  return results;
}

}  // namespace imp
