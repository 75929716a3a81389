// Pictures for tests, in text: # a certified hit, . a certified miss, ? undecided.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "runtime/render.h"
#include "tests/support/catalogue.h"

namespace imp::test {

inline RenderOptions sized(std::size_t width, std::size_t height) {
  RenderOptions options;
  options.width = width;
  options.height = height;
  options.workers = std::make_shared<Workers>(1);
  return options;
}

inline Picture render(const Model& model, const RenderOptions& options,
                      const std::vector<Override>& overrides = {}, std::optional<double> time = {}) {
  Diagnostics diagnostics;
  const auto uniforms = uniform_values(model, overrides, time, diagnostics);
  const auto renderer = Renderer::make(model, options, diagnostics);
  if (!uniforms || !renderer) throw std::runtime_error("no picture");
  return renderer->frame(*uniforms);
}

// Whether one is a certified hit and the other a certified miss.
inline bool contradict(double a, double b) {
  return (a == verdict_hit && b == verdict_miss) || (a == verdict_miss && b == verdict_hit);
}

inline std::string verdicts(const Picture& picture) {
  std::string result = "\n";
  for (std::size_t i = 0; i < picture.verdict.size(); ++i) {
    const float verdict = picture.verdict[i];
    result += verdict == verdict_hit ? '#' : verdict == verdict_miss ? '.' : '?';
    if ((i + 1) % picture.width == 0) result += '\n';
  }
  return result;
}

}  // namespace imp::test
