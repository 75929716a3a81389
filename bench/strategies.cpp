// What a strategy takes for a frame of 1024 x 1024, alone and behind tiles, to nearest and outward, on one thread.
//
// Beside them what hand-written kernels of the same methods took, with AVX-512, to nearest, on one thread of
// 223 GFLOP/s, scaled to this machine by its peak. "Tiles" are affine forms over beams of 64, 16 and 8 pixels with the
// best strategy behind them.
#include <fmt/format.h>

#include <array>

#include "bench/clocks.h"
#include "bench/peak.h"
#include "bench/surfaces.h"
#include "bench/tables.h"

namespace imp::bench {
namespace {

struct Way {
  const char* name;
  const char *search, *inclusion;
  bool tiles;
};

constexpr Way ways[] = {
    {"bisection, intervals", "stackless", "ia", false},
    {"bisection, affine", "stackless", "af1", false},
    {"isolate, affine", "isolate", "af1", false},
    {"bernstein", "bernstein", "auto", false},
    {"tiles", "auto", "auto", true},
};

struct Row {
  const char* surface;
  std::array<double, std::size(ways)> by_hand_ms;  // 0: not measured
};

constexpr double by_hand_gflops = 223;

constexpr Row rows[] = {
    {"sphere", {34, 30, 14, 9.1, 5.7}},        {"steiner", {66, 42, 40, 12, 7.7}},
    {"mitchell", {143, 46, 35, 14, 8.6}},      {"tangle", {51, 41, 25, 11, 6.8}},
    {"barth_sextic", {123, 66, 78, 17, 11.6}}, {"barth_decic", {517, 151, 203, 66, 53}},
    {"decocube", {96, 106, 133, 30, 21}},      {"superquadric_knoll", {49, 0, 0, 0, 23}},
    {"sin_blob", {676, 342, 366, 0, 58}},      {"water", {183, 267, 69, 0, 21}},
    {"blinn_gauss", {97, 125, 107, 0, 11.7}},
};

constexpr int rounds = 3;

Scene prepared(const char* surface, const Way& way, const std::shared_ptr<Workers>& workers, bool outward) {
  RenderOptions options;
  options.workers = workers;
  options.tiles = way.tiles;
  options.wish = {search_named(way.search), inclusion_named(way.inclusion)};
  options.kernel.outward = outward;
  // The hand-written bisection stops there.
  if (options.wish.search == search_named("stackless")) options.limits.epsilon = 0x1p-11;
  return scene(surface, options);
}

double milliseconds(const Scene& scene, Picture& picture) {
  const ThreadClock clock;
  picture = scene.renderer->frame(scene.uniforms, {}, {}, std::move(picture));
  return clock.milliseconds();
}

void print_row(const char* surface, const Way& way, double by_hand_ms, const std::shared_ptr<Workers>& one) {
  const Scene nearest = prepared(surface, way, one, false), outward = prepared(surface, way, one, true);
  Picture picture;
  milliseconds(outward, picture);  // makes the kernel in double, where it is needed
  std::vector<double> peaks, plain, sound, price;
  for (int round = 0; round < rounds; ++round) {
    peaks.push_back(peak_gflops());
    plain.push_back(milliseconds(nearest, picture));
    sound.push_back(milliseconds(outward, picture));
    price.push_back(sound.back() / plain.back());
  }
  const double by_hand = by_hand_ms * by_hand_gflops / median(peaks);
  fmt::print("| {} | {} | {:.1f} | {:.1f} | {:.2f} | {:.0f} | {:.2f} | {:.2f} |\n", surface, way.name,
             median(plain), median(sound), median(price), by_hand, median(plain) / by_hand,
             median(sound) / by_hand);
  std::fflush(stdout);
}

}  // namespace

void print_strategies_table() {
  const auto one = std::make_shared<Workers>(1);
  fmt::print(
      "1024 x 1024, the processor time of one thread, medians of {} frames; bisection to epsilon 2^-11\n\n"
      "| surface | strategy | nearest, ms | outward, ms | outward / nearest | by hand, scaled, ms | nearest "
      "/ by hand | outward / by hand |\n| --- | --- |{}\n",
      rounds, " ---: | ---: | ---: | ---: | ---: | ---: |");
  for (const Row& row : rows)
    for (std::size_t i = 0; i < std::size(ways); ++i)
      if (row.by_hand_ms[i] > 0 && !only.skips(row.surface))
        print_row(row.surface, ways[i], row.by_hand_ms[i], one);
}

}  // namespace imp::bench
