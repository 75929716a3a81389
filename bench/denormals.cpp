// Denormals: what x^500 costs where it underflows, as a value and as an enclosure. No kernel flushes
// denormals; the interval rule of powers stays out of them by itself.
//   tools/dev bench --benchmark_filter=denormal
#include <benchmark/benchmark.h>

#include "bench/surfaces.h"
#include "runtime/evaluate.h"

namespace imp::bench {
namespace {

constexpr std::size_t rows = 1 << 14;

void power(benchmark::State& state, Evaluation evaluation, double x) {
  Diagnostics diagnostics;
  const auto model = parse_model("x^500 + y^35 + z^4 = 1", "power", diagnostics);
  const auto program = evaluation_program(model->surfaces[0], evaluation, f32, diagnostics);
  const auto kernel = make_kernel(*program, {});
  if (!kernel) return state.SkipWithError(kernel.error().message.c_str());
  const std::vector<Column> inputs((*kernel)->program().inputs.size(), Column(rows, x));
  for (auto _ : state) benchmark::DoNotOptimize(run_rows(**kernel, inputs, rows));
}

const bool registered = [] {
  for (const auto& [name, evaluation] :
       {std::pair{"value", Evaluation::f}, {"enclosure", Evaluation::interval}})
    for (const auto& [where, x] : {std::pair{"normal", 1.0}, {"underflowing", 0.8}})
      benchmark::RegisterBenchmark(
          (std::string("denormal/") + name + "/" + where).c_str(),
          [=, e = evaluation, at = x](benchmark::State& state) { power(state, e, at); })
          ->Unit(benchmark::kMicrosecond);
  return true;
}();

}  // namespace
}  // namespace imp::bench
