#include "bench/surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace imp::bench {
namespace {

[[noreturn]] void fail(const Diagnostics& diagnostics) {
  fmt::print(stderr, "{}", to_text(diagnostics));
  std::exit(1);
}

}  // namespace

Model example(const std::string& name) {
  const std::string path = std::string(IMP_SOURCE_DIR) + "/examples/surfaces/" + name + ".imp";
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  Diagnostics diagnostics;
  auto model = parse_model(text.str(), path, diagnostics);
  if (!model) fail(diagnostics);
  return *std::move(model);
}

std::vector<std::string> example_names() {
  std::vector<std::string> names;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(IMP_SOURCE_DIR) + "/examples/surfaces"))
    if (entry.path().extension() == ".imp") names.push_back(entry.path().stem());
  std::ranges::sort(names);
  return names;
}

Scene scene(const std::string& name, const RenderOptions& options) {
  Scene result{.model = std::make_unique<Model>(example(name)), .renderer = {}, .uniforms = {}};
  Diagnostics diagnostics;
  auto renderer = Renderer::make(*result.model, options, diagnostics);
  auto uniforms = uniform_values(*result.model, {}, {}, diagnostics);
  if (!renderer || !uniforms) fail(diagnostics);
  result.renderer = std::make_unique<Renderer>(*std::move(renderer));
  result.uniforms = *std::move(uniforms);
  return result;
}

}  // namespace imp::bench
