#include "tests/prove/pictures.h"

#include <algorithm>
#include <cmath>

#include "runtime/search/search.h"
#include "tests/prove/rows.h"
#include "tests/support/catalogue.h"
#include "tests/support/picture.h"

namespace imp::prove {
namespace {

constexpr std::size_t most_drawn_otherwise = 40;  // pixels: 35 where float decides nothing, else 11 at most

bool contradict(float a, float b) {
  return (a == verdict_hit && b == verdict_miss) || (a == verdict_miss && b == verdict_hit);
}

std::string picture_row(const test::SurfaceEntry& entry, std::size_t size) {
  const Model model = test::model_of(entry);
  RenderOptions options = test::sized(size, size);
  options.depth = true;
  const Picture code = test::render(model, options);

  options.kernel.backend = Backend::glsl;
  Diagnostics diagnostics;
  const auto uniforms = uniform_values(model, {}, {}, diagnostics);
  const auto renderer = Renderer::make(model, options, diagnostics);
  if (!renderer || !uniforms)
    return fmt::format("| {} | {} | | | | | refused |", entry.id, code.count(verdict_hit));
  const Picture shader = renderer->frame(*uniforms);

  std::size_t drawn_otherwise = 0, other_verdict = 0, contradictions = 0;
  for (std::size_t i = 0; i < code.verdict.size(); ++i) {
    drawn_otherwise += std::isfinite(code.depth[i]) != std::isfinite(shader.depth[i]) ? 1 : 0;
    other_verdict += code.verdict[i] != shader.verdict[i] ? 1 : 0;
    contradictions += contradict(code.verdict[i], shader.verdict[i]) ? 1 : 0;
  }
  const bool holds = contradictions == 0 && drawn_otherwise <= most_drawn_otherwise;
  return fmt::format("| {} | {} | {} | {} | {} | {} | {} |", entry.id, code.count(verdict_hit),
                     shader.count(verdict_hit), drawn_otherwise, other_verdict, contradictions,
                     holds ? "holds" : "FAILS");
}

}  // namespace

bool pictures(const PictureOptions& options) {
  fmt::print(
      "{0} x {0} pixels\n\n| surface | certified hits, llvm | glsl | drawn otherwise | another verdict | ",
      options.size);
  fmt::print("contradictions | |\n| --- | ---: | ---: | ---: | ---: | ---: | --- |\n");
  bool all_hold = true;
  for (const test::SurfaceEntry& entry : test::catalogue()) {
    if (!options.only.empty() && std::ranges::find(options.only, entry.id) == options.only.end()) continue;
    const std::string text = row(options.done, fmt::format("glsl-{}-{}", entry.id, options.size),
                                 [&] { return picture_row(entry, options.size); });
    all_hold &= !text.ends_with("FAILS |");
  }
  return all_hold;
}

}  // namespace imp::prove
