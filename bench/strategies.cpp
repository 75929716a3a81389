// What a strategy takes for a frame of 1024 x 1024, alone and behind tiles, to nearest and outward, on one thread.
// Beside them what hand-written kernels of the same methods took, scaled to this machine by its peak.
#include <fmt/format.h>

#include "bench/by_hand.h"
#include "bench/clocks.h"
#include "bench/peak.h"
#include "bench/surfaces.h"
#include "bench/tables.h"

namespace imp::bench {
namespace {

struct Method {
  Way way;
  const char* name;
  const char *search, *inclusion;
};

constexpr Method methods[] = {
    {Way::bisection, "bisection, intervals", "stackless", "ia"},
    {Way::affine_bisection, "bisection, affine", "stackless", "af1"},
    {Way::isolate, "isolate, affine", "isolate", "af1"},
    {Way::bernstein, "bernstein", "bernstein", "auto"},
    {Way::tiles, "tiles", "auto", "auto"},
};

constexpr int rounds = 3;

Scene prepared(const std::string& surface, const Method& method, const std::shared_ptr<Workers>& workers,
               bool outward) {
  RenderOptions options;
  options.workers = workers;
  options.tiles = method.way == Way::tiles;
  options.wish = {search_named(method.search), inclusion_named(method.inclusion)};
  options.kernel.outward = outward;
  options.kernel.target = only.target_name();
  // The hand-written bisection stops there.
  if (method.way <= Way::affine_bisection) options.limits.epsilon = 0x1p-11;
  return scene(surface, options);
}

double milliseconds(const Scene& scene, Picture& picture) {
  const ThreadClock clock;
  picture = scene.renderer->frame(scene.uniforms, {}, {}, std::move(picture));
  return clock.milliseconds();
}

void print_row(const ByHand& known, const Method& method, const std::shared_ptr<Workers>& one) {
  const std::string surface(known.surface);
  const Scene nearest = prepared(surface, method, one, false), outward = prepared(surface, method, one, true);
  Picture picture;
  milliseconds(outward, picture);  // makes the kernel in double, where it is needed
  std::vector<double> peaks, plain, sound, price;
  for (int round = 0; round < rounds; ++round) {
    peaks.push_back(peak_gflops(only.widest()));
    plain.push_back(milliseconds(nearest, picture));
    sound.push_back(milliseconds(outward, picture));
    price.push_back(sound.back() / plain.back());
  }
  const double scaled = known.frame(method.way) * by_hand_gflops / median(peaks);
  fmt::print("| {} | {} | {:.1f} | {:.1f} | {:.2f} | {:.0f} | {:.2f} | {:.2f} |\n", surface, method.name,
             median(plain), median(sound), median(price), scaled, median(plain) / scaled,
             median(sound) / scaled);
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
  for (const ByHand& known : by_hand())
    for (const Method& method : methods)
      if (known.frame(method.way) > 0 && !only.skips(known.surface)) print_row(known, method, one);
}

}  // namespace imp::bench
