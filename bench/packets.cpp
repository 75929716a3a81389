// Packets: how many registers wide they should be. Rays of a cast kernel, one thread.
//   tools/dev bench --benchmark_filter=packet --benchmark_enable_random_interleaving=true
#include <benchmark/benchmark.h>

#include <cmath>

#include "backends/llvm/compile.h"
#include "bench/surfaces.h"
#include "runtime/evaluate.h"

namespace imp::bench {
namespace {

constexpr std::size_t rays = 1 << 14;

// A grid of parallel rays through the cube from -2 to 2.
std::vector<Column> columns() {
  std::vector<Column> result(8, Column(rays));
  for (std::size_t i = 0; i < rays; ++i) {
    const double u = static_cast<double>(i % 128) / 32 - 2, v = static_cast<double>(i / 128) / 32 - 2;
    const double values[] = {u, v, -4, 0.1, 0.05, 1, 0, 8};
    for (std::size_t k = 0; k < result.size(); ++k) result[k][i] = values[k];
  }
  return result;
}

void packet(benchmark::State& state, const std::string& name, unsigned registers) {
  CpuTarget target = *cpu_target("host");
  target.packet_registers = registers;
  SearchLimits limits;
  limits.epsilon = 0x1p-11;
  Diagnostics diagnostics;
  const auto program = cast_program(example(name).surfaces[0], *search_named("stackless"),
                                    inclusions().front(), limits, f32, diagnostics);
  const auto kernel = compile(lower(*program, {}), target);
  if (!kernel) return state.SkipWithError(kernel.error().message.c_str());
  const auto inputs = columns();
  for (auto _ : state) benchmark::DoNotOptimize(run_rows(**kernel, inputs, rays));
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * rays));
}

const bool registered = [] {
  for (const char* name : {"steiner", "tangle", "barth_sextic"})
    for (const unsigned registers : {1u, 2u, 4u})
      benchmark::RegisterBenchmark((std::string("packet/") + name + "/" + std::to_string(registers)).c_str(),
                                   [=](benchmark::State& state) { packet(state, name, registers); })
          ->Unit(benchmark::kMillisecond);
  return true;
}();

}  // namespace
}  // namespace imp::bench
