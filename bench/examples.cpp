// Every example as the command draws it: what it takes to make its kernels and to run them, and what is left undecided.
#include <fmt/format.h>

#include <numeric>

#include "bench/clocks.h"
#include "bench/surfaces.h"
#include "bench/tables.h"

namespace imp::bench {
namespace {

constexpr int rounds = 3;

void print_row(const std::string& name, const std::shared_ptr<Workers>& workers) {
  RenderOptions options;
  options.kernel.target = only.target_name();
  options.width = options.height = 512;
  options.workers = workers;
  options.steps = true;
  const WallClock making;
  const Scene drawn = scene(name, options);
  const double made = making.milliseconds();
  const WallClock first_frame;
  Picture picture = drawn.renderer->frame(drawn.uniforms);
  const double first = first_frame.milliseconds();
  std::vector<double> milliseconds;
  for (int round = 0; round < rounds; ++round) {
    const WallClock clock;
    picture = drawn.renderer->frame(drawn.uniforms, {}, {}, std::move(picture));
    milliseconds.push_back(clock.milliseconds());
  }
  const double steps = std::accumulate(picture.steps.begin(), picture.steps.end(), 0.0);
  fmt::print("| {} | {} | {} | {:.0f} | {:.0f} | {:.1f} | {:.1f} | {} |\n", name,
             drawn.renderer->methods()[0].search->name, drawn.renderer->program().graph.size(), made, first,
             median(milliseconds), steps / static_cast<double>(picture.steps.size()),
             picture.count(verdict_undecided));
  std::fflush(stdout);
}

}  // namespace

void print_examples_table() {
  const auto workers = std::make_shared<Workers>();
  fmt::print(
      "512 x 512, {} threads, by the clock on the wall; frames: the first, which may make a kernel in "
      "double, and the median of {} more\n\n"
      "| surface | search | nodes a pixel | to make, ms | first frame, ms | frame, ms | steps a ray | "
      "undecided pixels |\n| --- | --- |{}\n",
      workers->size(), rounds, " ---: | ---: | ---: | ---: | ---: | ---: |");
  for (const std::string& name : example_names())
    if (!only.skips(name)) print_row(name, workers);
}

}  // namespace imp::bench
