// Frames: what a picture costs, and what outward rounding adds to it. One thread, 512 × 512,
// epsilon 2^-11 as in Knoll et al. 2009, Table 1. Compare the times of one run with each other only:
//   tools/dev bench --benchmark_filter=frame --benchmark_enable_random_interleaving=true
#include <benchmark/benchmark.h>

#include <numeric>

#include "bench/surfaces.h"

namespace imp::bench {
namespace {

void frame(benchmark::State& state, const std::string& name, bool outward) {
  RenderOptions options;
  options.width = options.height = 512;
  options.workers = std::make_shared<Workers>(1);
  options.steps = true;
  options.limits.epsilon = 0x1p-11;
  options.tiles = false;
  options.wish = {search_named("stackless"), inclusion_named("ia")};
  options.kernel.outward = outward;
  const Scene drawn = scene(name, options);
  Picture picture;
  for (auto _ : state) picture = drawn.renderer->frame(drawn.uniforms);
  const double pixels = static_cast<double>(picture.verdict.size());
  state.counters["steps"] = std::accumulate(picture.steps.begin(), picture.steps.end(), 0.0) / pixels;
  state.counters["undecided"] = static_cast<double>(picture.count(verdict_undecided)) / pixels;
}

const bool registered = [] {
  for (const char* name : knoll_table_1)
    for (const bool outward : {false, true})
      benchmark::RegisterBenchmark(
          (std::string("frame/") + name + (outward ? "/outward" : "/nearest")).c_str(),
          [name, outward](benchmark::State& state) { frame(state, name, outward); })
          ->Unit(benchmark::kMillisecond);
  return true;
}();

}  // namespace
}  // namespace imp::bench
