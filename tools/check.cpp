// imp check: says what is wrong in files.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "runtime/view.h"
#include "tools/input.h"
#include "tools/verbs.h"

namespace imp::tools {
namespace {

using Json = nlohmann::ordered_json;

std::string_view word(Severity severity) {
  switch (severity) {
    case Severity::error:   return "error";
    case Severity::warning: return "warning";
    case Severity::note:    return "note";
  }
  return {};
}

// `end_column` is one past the last character, on the line where the diagnostic begins.
Json to_json(const Sources& sources, const Diagnostic& diagnostic, const std::string& file) {
  Json json{{"file", file}, {"line", nullptr}, {"column", nullptr}, {"end_column", nullptr}};
  if (Span span = diagnostic.span; span.valid()) {
    const std::string_view text = sources.text(span.file);
    const std::size_t line_end = std::min(text.find('\n', span.begin), text.size());
    const auto begin = position(sources, span);
    span.begin = static_cast<std::uint32_t>(std::clamp<std::size_t>(span.end, span.begin, line_end));
    json = {{"file", sources.name(span.file)},
            {"line", begin.line},
            {"column", begin.column},
            {"end_column", std::max(position(sources, span).column, begin.column + 1)}};
  }
  json["severity"] = word(diagnostic.severity);
  json["message"] = diagnostic.message;
  return json;
}

struct Check {
  std::vector<std::string> files;
  bool json = false;

  Exit run() const {
    Exit exit = fine;
    Json all = Json::array();
    for (const std::string& file : files) {
      Diagnostics diagnostics;
      const auto model = read_model(file, diagnostics);
      const auto uniforms = model ? uniform_values(*model, {}, {}, diagnostics) : std::nullopt;
      if (!uniforms || !check_view(*model, *uniforms, diagnostics)) exit = failed;
      if (!json) print(diagnostics);
      for (const Diagnostic& diagnostic : diagnostics.all())
        all.push_back(to_json(diagnostics.sources, diagnostic, shown_name(file)));
    }
    if (!json) return exit;
    Output output;
    output.text = all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
    Diagnostics diagnostics;
    if (output.close(diagnostics)) return exit;
    print(diagnostics);
    return failed;
  }
};

}  // namespace

Action add_check(CLI::App& verb) {
  auto check = std::make_shared<Check>();
  verb.add_option("F.imp", check->files, "the files; - is standard input")->required();
  verb.add_flag("--json", check->json, "on standard output, as an array of diagnostics");
  return [check] { return check->run(); };
}

}  // namespace imp::tools
