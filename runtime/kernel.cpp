#include "runtime/kernel.h"

#include "backends/glsl/kernel.h"
#include "backends/llvm/compile.h"
#include "ir/assert.h"
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

}  // namespace

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
