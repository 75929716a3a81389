#include "tools/report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace imp::tools {
namespace {

std::string_view rounding(const Options& options) { return options.kernel.outward ? "outward" : "nearest"; }

void print_text(const Report& report, const Options& options) {
  fmt::print(stderr, "{} {} in {:.2f} ms", report.count, report.things, report.milliseconds);
  if (report.verdicts)
    fmt::print(stderr, ": {} hit, {} miss, {} undecided", report.verdicts->hit, report.verdicts->miss,
               report.verdicts->undecided);
  if (report.steps)
    fmt::print(stderr, "; steps {:.1f} in the mean, {} at most", report.steps->mean, report.steps->max);
  fmt::print(stderr, "\nbackend {}, target {}, precision {}, rounding {}",
             backend_name(options.kernel.backend), options.kernel.target,
             precision_name(options.kernel.precision), rounding(options));
  fmt::print(stderr, "\n");
  for (const Method& method : report.methods) fmt::print(stderr, "{}\n", to_text(method));
}

void print_json(const Report& report, const Timings& timings, const Options& options) {
  nlohmann::ordered_json json;
  json[std::string(report.things)] = report.count;
  json["milliseconds"] = report.milliseconds;
  if (report.verdicts) {
    json["hit"] = report.verdicts->hit;
    json["miss"] = report.verdicts->miss;
    json["undecided"] = report.verdicts->undecided;
  }
  if (report.steps) json["steps"] = {{"mean", report.steps->mean}, {"max", report.steps->max}};
  json["backend"] = backend_name(options.kernel.backend);
  json["target"] = options.kernel.target;
  json["precision"] = precision_name(options.kernel.precision);
  json["rounding"] = rounding(options);
  if (!report.methods.empty()) {
    json["search"] = report.methods.front().search->name;
    json["inclusion"] = report.methods.front().inclusion->name;
    json["why"] = report.methods.front().reason;
  }
  for (const auto& [name, milliseconds] : timings.entries)
    if (options.timings) json["timings"][name] = milliseconds;
  fmt::print(stderr, "{}\n", json.dump());
}

}  // namespace

void print(const Timings& timings, const Options& options) {
  for (const auto& [name, milliseconds] : timings.entries)
    if (options.timings) fmt::print(stderr, "{:16} {:9.2f} ms\n", name, milliseconds);
}

void print(const Report& report, const Timings& timings, const Options& options) {
  if (options.stats == "json") return print_json(report, timings, options);
  if (options.stats == "text") print_text(report, options);
  print(timings, options);
}

}  // namespace imp::tools
