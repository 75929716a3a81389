#include "tools/input.h"

#include <cerrno>
#include <cstring>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "passes/exponents.h"

namespace imp::tools {
namespace {

std::vector<std::string_view> surface_names(const Model& model) {
  std::vector<std::string_view> names;
  names.reserve(model.surfaces.size());
  for (const Surface& surface : model.surfaces) names.push_back(surface.name);
  return names;
}

}  // namespace

std::string shown_name(const std::string& path) { return path == "-" ? "<stdin>" : path; }

std::optional<std::string> read_text(const std::string& path, Diagnostics& diagnostics) {
  const auto fail = [&]() -> std::optional<std::string> {
    diagnostics.error(fmt::format("cannot read '{}': {}", shown_name(path), std::strerror(errno)));
    return std::nullopt;
  };
  using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;
  File opened(path == "-" ? nullptr : std::fopen(path.c_str(), "rb"),
              [](std::FILE* f) { return std::fclose(f); });
  if (path != "-" && !opened) return fail();
  std::FILE* file = path == "-" ? stdin : opened.get();

  std::string text;
  constexpr std::size_t piece = std::size_t{1} << 18;
  for (std::size_t used = 0;;) {
    text.resize(used + piece);
    const std::size_t count = std::fread(text.data() + used, 1, piece, file);
    used += count;
    if (count == piece) continue;
    text.resize(used);
    if (std::ferror(file) != 0) return fail();
    return text;
  }
}

std::optional<Model> read_model(const std::string& path, Diagnostics& diagnostics) {
  auto text = read_text(path, diagnostics);
  if (!text) return std::nullopt;
  auto model = parse_model(std::move(*text), shown_name(path), diagnostics);
  if (!model) return std::nullopt;
  bool good = check_exponents(model->settings, diagnostics);
  for (const Surface& surface : model->surfaces) good = check_exponents(surface.f, diagnostics) && good;
  return good ? std::move(model) : std::nullopt;
}

std::optional<std::size_t> choose_surface(const Model& model, const std::string& name,
                                          Diagnostics& diagnostics) {
  if (name.empty() && model.surfaces.size() == 1) return 0;
  const std::vector<std::string_view> names = surface_names(model);
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return i;
  const std::string all = fmt::format("{}", fmt::join(names, ", "));
  if (name.empty()) {
    diagnostics.error("the file has several surfaces; choose one with --surface: " + all);
  } else {
    const std::string hint = did_you_mean(name, names);
    diagnostics.error(fmt::format("no surface '{}'{}", name, hint.empty() ? "; the file has " + all : hint));
  }
  return std::nullopt;
}

void say(std::string_view text) noexcept { std::fwrite(text.data(), 1, text.size(), stderr); }

void print(const Diagnostics& diagnostics) { fmt::print(stderr, "{}", to_text(diagnostics)); }

void Output::pass_on(bool all) {
  constexpr std::size_t much = std::size_t{1} << 18;
  if (!all && text.size() < much) return;
  if (error_ == 0 && std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) error_ = errno;
  text.clear();
}

bool Output::close(Diagnostics& diagnostics) {
  pass_on(true);
  if (std::fflush(stdout) != 0 && error_ == 0) error_ = errno;
  if (error_ == 0) return true;
  std::clearerr(stdout);
  diagnostics.error(fmt::format("cannot write to standard output: {}", std::strerror(error_)));
  return false;
}

}  // namespace imp::tools
