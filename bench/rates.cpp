// Frames a second as the command draws them: search auto, outward rounding, tiles, the second look in double.
//
// Beside them what is asked for: the frames a second that hand-written kernels of the best methods known for each
// surface could show, without outward rounding and with AVX-512, on two threads of 449 GFLOP/s, scaled by the peaks.
#include <fmt/format.h>

#include <numeric>
#include <thread>

#include "bench/clocks.h"
#include "bench/peak.h"
#include "bench/surfaces.h"
#include "bench/tables.h"

namespace imp::bench {
namespace {

struct Row {
  const char* surface;
  double asked, stretch;  // frames a second
};

constexpr double by_hand_gflops = 449;  // of both threads

constexpr Row rows[] = {
    {"sphere", 280, 450},  {"steiner", 150, 300},           {"mitchell", 190, 350},
    {"tangle", 240, 400},  {"barth_sextic", 135, 240},      {"barth_decic", 30, 70},
    {"decocube", 65, 140}, {"superquadric_knoll", 60, 200}, {"sin_blob", 24, 80},
    {"water", 75, 160},    {"blinn_gauss", 125, 240},
};

constexpr int rounds = 7;

// Of all these threads together.
double peak_of(std::size_t threads) {
  std::vector<double> peaks(threads);
  {
    std::vector<std::jthread> all;
    for (double& peak : peaks) all.emplace_back([&peak] { peak = peak_gflops(only.widest()); });
  }
  return std::accumulate(peaks.begin(), peaks.end(), 0.0);
}

void print_row(const Row& row, const std::shared_ptr<Workers>& workers) {
  RenderOptions options;
  options.workers = workers;
  options.steps = true;
  options.kernel.target = only.target_name();
  const Scene drawn = scene(row.surface, options);
  Picture picture = drawn.renderer->frame(drawn.uniforms);  // makes the kernel in double, where it is needed
  std::vector<double> peaks, milliseconds;
  for (int round = 0; round < rounds; ++round) {
    peaks.push_back(peak_of(workers->size()));
    const WallClock clock;
    picture = drawn.renderer->frame(drawn.uniforms, {}, {}, std::move(picture));
    milliseconds.push_back(clock.milliseconds());
  }
  const double fps = 1000 / median(milliseconds), speed = median(peaks) / by_hand_gflops;
  const double steps = std::accumulate(picture.steps.begin(), picture.steps.end(), 0.0);
  fmt::print("| {} | {:.1f} | {:.0f} | {:.0f} | {:.2f} | {:.2f} | {} | {:.1f} |\n", row.surface, fps,
             median(peaks), row.asked * speed, fps / (row.asked * speed), fps / (row.stretch * speed),
             picture.count(verdict_undecided), steps / static_cast<double>(picture.steps.size()));
  std::fflush(stdout);
}

}  // namespace

void print_rates_table() {
  const auto workers = std::make_shared<Workers>();
  fmt::print(
      "1024 x 1024, {} threads, medians of {} frames by the clock on the wall; asked for and stretch scaled "
      "by the peaks\n\n"
      "| surface | frames a second | peak, GFLOP/s | asked for | of it | of the stretch | undecided pixels | "
      "steps a ray |\n| --- |{}\n",
      workers->size(), rounds, " ---: | ---: | ---: | ---: | ---: | ---: | ---: |");
  for (const Row& row : rows)
    if (!only.skips(row.surface)) print_row(row, workers);
}

}  // namespace imp::bench
