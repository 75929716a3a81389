// The surfaces of Knoll et al. 2009, Table 1, by interval bisection at epsilon = 2^-11, 1024 x 1024.
//
// Beside them: the frames a second of the paper (four cores of 2.33 GHz with SSE, interval arithmetic), and
// what a hand-written kernel of the same method took, scaled to this machine by its peak.
#include <fmt/format.h>

#include "bench/by_hand.h"
#include "bench/clocks.h"
#include "bench/peak.h"
#include "bench/surfaces.h"
#include "bench/tables.h"

namespace imp::bench {
namespace {

struct Row {
  const char* surface;
  double paper_fps;  // 0: not in the paper
};

constexpr Row rows[] = {
    {"sphere", 15},
    {"steiner", 7.5},
    {"mitchell", 5.2},
    {"teardrop", 5.5},
    {"bretzel4", 13},
    {"klein_bottle", 11},
    {"tangle", 3.2},
    {"decocube", 5.5},
    {"barth_sextic", 7.4},
    {"barth_decic", 0.92},
    {"superquadric_knoll", 18},
    {"sin_blob", 0.71},
    {"cloth", 2.2},
    {"water", 2.2},
    {"blinn_gauss", 0},
};

constexpr int rounds = 5;

struct Measured {
  std::vector<double> milliseconds;
  double undecided = 0;  // share of the pixels
};

Scene prepared(const char* surface, const std::shared_ptr<Workers>& workers, bool outward) {
  RenderOptions options;
  options.workers = workers;
  options.limits.epsilon = 0x1p-11;
  options.tiles = false;
  options.wish = {search_named("stackless"), inclusion_named("ia")};
  options.kernel.outward = outward;
  options.kernel.target = only.target_name();
  return scene(surface, options);
}

// By the clock on the wall, or by the time of this thread.
template <class Clock>
void measure(const Scene& scene, Measured& into) {
  const Clock clock;
  const Picture picture = scene.renderer->frame(scene.uniforms);
  into.milliseconds.push_back(clock.milliseconds());
  into.undecided =
      static_cast<double>(picture.count(verdict_undecided)) / static_cast<double>(picture.verdict.size());
}

std::string ratio(double a, double b) { return b > 0 ? fmt::format("{:.2f}", a / b) : "-"; }

}  // namespace

void print_knoll_table() {
  const auto one = std::make_shared<Workers>(1), all = std::make_shared<Workers>();
  fmt::print(
      "1024 x 1024, epsilon 2^-11, medians of {} frames; the processor time of one thread, frames a second "
      "by the clock on the wall\n\n",
      rounds);
  fmt::print(
      "| surface | nearest, ms | outward, ms | outward / nearest | peak, GFLOP/s | by hand, scaled, ms | "
      "nearest / by "
      "hand | undecided % | fps, {} threads | fps, paper |\n| --- |{}\n",
      all->size(), std::string(" ---: |").append(" ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"));
  for (const Row& row : rows) {
    if (only.skips(row.surface)) continue;
    const Scene nearest = prepared(row.surface, one, false), outward = prepared(row.surface, one, true);
    const Scene together = prepared(row.surface, all, true);
    Measured plain, sound, fast;
    std::vector<double> peaks, price;
    for (int round = 0; round < rounds; ++round) {
      peaks.push_back(peak_gflops(only.widest()));
      measure<ThreadClock>(nearest, plain);
      measure<ThreadClock>(outward, sound);
      measure<WallClock>(together, fast);
      price.push_back(sound.milliseconds.back() / plain.milliseconds.back());
    }
    const ByHand* known = by_hand(row.surface);
    const double peak = median(peaks);
    const double scaled = known && peak > 0 ? known->frame(Way::bisection) * by_hand_gflops / peak : 0;
    fmt::print("| {} | {:.1f} | {:.1f} | {:.2f} | {:.0f} | {} | {} | {:.2f} | {:.1f} | {} |\n", row.surface,
               median(plain.milliseconds), median(sound.milliseconds), median(price), peak,
               scaled > 0 ? fmt::format("{:.0f}", scaled) : "-", ratio(median(plain.milliseconds), scaled),
               100 * sound.undecided, 1000 / median(fast.milliseconds),
               row.paper_fps > 0 ? fmt::format("{}", row.paper_fps) : "-");
    std::fflush(stdout);
  }
}

}  // namespace imp::bench
