#include "tests/prove/surfaces.h"

#include <fmt/ranges.h>

#include "backends/llvm/target.h"
#include "tests/prove/cores.h"
#include "tests/prove/rows.h"
#include "tests/support/surface_trial.h"

namespace imp::prove {
namespace {

constexpr std::uint64_t boxes_at_once = 100;
constexpr std::size_t points_a_box = 4;

// Every target that runs here, each by its name.
std::vector<std::string> targets() {
  std::vector<std::string> names;
  for (const CpuTarget& target : cpu_targets())
    if (target.runs_here && target.name != "host") names.push_back(target.name);
  return names;
}

std::string listed(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string surface_row(const test::SurfaceEntry& entry, std::uint64_t samples) {
  const test::TriedSurface surface(entry);
  std::vector<std::unique_ptr<Kernel>> kernels;
  std::vector<const Kernel*> tried;
  std::vector<std::string> with, without;
  for (const Inclusion& form : imp::inclusions()) {
    bool all = true;
    for (const Type type : {f32, f64})
      for (const std::string& target : targets()) {
        auto kernel = surface.enclosure(form, type, {.target = target});
        all &= kernel != nullptr;
        if (!kernel) continue;
        tried.push_back(kernel.get());
        kernels.push_back(std::move(kernel));
      }
    (all ? with : without).emplace_back(form.name);
  }
  const auto count = on_all_cores<test::SurfaceCount>(
      (samples + boxes_at_once - 1) / boxes_at_once, [&](std::uint64_t seed) {
        return test::try_surface(surface, tried, seed, boxes_at_once, points_a_box);
      });
  if (!count.first.empty()) fmt::print(stderr, "{}, wrong, the first: {}\n", entry.id, count.first);
  return fmt::format("| {} | {} | {} | {} | {} | {} | {} |", entry.id, listed(with), listed(without),
                     count.boxes, count.values, count.misses + count.overclaimed,
                     count.misses + count.overclaimed == 0 ? "holds" : "FAILS");
}

}  // namespace

bool surfaces(const SurfaceOptions& options) {
  fmt::print("In float and double, on {}\n\n", listed(targets()));
  fmt::print("| surface | forms | without a rule | boxes | values | wrong | |\n");
  fmt::print("| --- | --- | --- | ---: | ---: | ---: | --- |\n");
  bool all_hold = true;
  for (const test::SurfaceEntry& entry : test::catalogue()) {
    if (!options.only.empty() && std::ranges::find(options.only, entry.id) == options.only.end()) continue;
    const std::string key = fmt::format("surface-{}-{}-{}-{}", entry.id, imp::inclusions().size(),
                                        fmt::join(targets(), "-"), options.samples);
    all_hold &=
        !row(options.done, key, [&] { return surface_row(entry, options.samples); }).ends_with("FAILS |");
  }
  return all_hold;
}

}  // namespace imp::prove
