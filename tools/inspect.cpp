// imp inspect: a Program as text, after every pass, and what the backends make of it.
#include <algorithm>
#include <expected>
#include <sstream>

#include <fmt/format.h>

#include "backends/glsl/emit.h"
#include "backends/llvm/compile.h"
#include "ir/text.h"
#include "passes/surface_passes.h"
#include "runtime/evaluate.h"
#include "runtime/pixel.h"
#include "tools/input.h"
#include "tools/op_counts.h"
#include "tools/options.h"
#include "tools/report.h"
#include "tools/text_table.h"
#include "tools/verbs.h"

namespace imp::tools {
namespace {

using Text = std::expected<std::string, Refusal>;

Text emit_ir(const Program& program, const Options& /*options*/) { return to_text(program); }

Text emit_code(const Program& program, const Options& options, CodeForm form) {
  return emit(program, *cpu_target(options.kernel.target), form);
}
Text emit_ll(const Program& program, const Options& options) {
  return emit_code(program, options, CodeForm::llvm_ir);
}
Text emit_asm(const Program& program, const Options& options) {
  return emit_code(program, options, CodeForm::assembly);
}

Text emit_shader(const Program& program, const Options& /*options*/) { return emit_glsl(program); }

struct Emission {
  std::string_view name;
  Text (*write)(const Program&, const Options&);  // null: not there yet
};

constexpr Emission emissions[] = {
    {"ir", emit_ir}, {"ll", emit_ll}, {"asm", emit_asm}, {"glsl", emit_shader}, {"dot", nullptr},
};

std::vector<Choice> emission_choices() {
  std::vector<Choice> choices;
  for (const Emission& emission : emissions)
    choices.push_back({emission.name, "", emission.write != nullptr});
  return choices;
}

// What tables go through, and the kernels of imp cast and imp render.
std::vector<Choice> program_choices() {
  std::vector<Choice> choices(evaluations().begin(), evaluations().end());
  choices.insert(choices.begin(), {{"cast", ""}, {"pixel", ""}});
  std::ranges::rotate(choices, choices.begin() + 2);
  return choices;
}

std::vector<Choice> pass_choices() {
  std::vector<Choice> choices;
  for (const Pass& pass : all_passes())
    if (std::ranges::find(choices, pass.name, &Choice::name) == choices.end())
      choices.push_back({pass.name, ""});
  return choices;
}

std::string counts_text(const Program& program) {
  const Table table = op_counts(program);
  return table.empty() ? "" : "\n" + to_text(table, Align::numbers, "# ");
}

std::string times_text(const PassTrace& trace) {
  Table table{{"pass", "ms", "nodes before", "after", ""}};
  for (const PassTime& pass : trace.times)
    table.push_back({std::string(pass.name),
                     fmt::format("{:.3f}", std::chrono::duration<double, std::milli>(pass.time).count()),
                     std::to_string(pass.nodes_before), std::to_string(pass.nodes_after),
                     pass.changed ? "" : "unchanged"});
  return "\n" + to_text(table, Align::numbers, "# ");
}

struct Inspect {
  Options options;
  std::string file, program = "f";
  const Emission* emission = nullptr;
  bool passes = false;
  std::optional<double> economize;  // of pixels
  std::string_view print_after;

  void settle() const {
    if (!options.stats.empty()) refuse("--stats", "nothing is evaluated here; ops are counted without it");
    if (emission && (passes || !print_after.empty()))
      refuse("--emit", "shows what comes after the passes; --passes and --print-after show what is between");
  }

  // What only the interpreter would run is shown too.
  const KernelOptions longest{.backend = Backend::interpreter};

  // The Program that was asked for, before the passes.
  std::optional<Program> build(const Model& model, Diagnostics& diagnostics) const {
    const Type precision = options.kernel.precision;
    if (program == "pixel" && options.surface.empty()) return pixel(model, {}, diagnostics);
    const auto surface = choose_surface(model, options.surface, diagnostics);
    if (!surface) return std::nullopt;
    if (program == "pixel") return pixel(model, {*surface}, diagnostics);
    if (program == "cast") {
      const Program f = simplified(model.surfaces[*surface].f);
      if (const auto why = far_too_long_to_search(f, longest)) {
        diagnostics.error(model.surfaces[*surface].span, why->message);
        return std::nullopt;
      }
      const Method method = choose_method(f, options.wish, options.kernel);
      return cast_program(model.surfaces[*surface], *method.search, *method.inclusion, options.limits,
                          precision, diagnostics);
    }
    return evaluation_program(model.surfaces[*surface], *evaluation_named(program), precision, diagnostics,
                              options.named_inclusion);
  }

  // How rays are searched, where they are: a line for each surface.
  std::string methods_text(const Model& model) const {
    if (program != "cast" && program != "pixel") return "";
    std::string text = "\n";
    for (std::size_t i = 0; i < model.surfaces.size(); ++i) {
      const Surface& surface = model.surfaces[i];
      if (!options.surface.empty() && surface.name != options.surface) continue;
      const std::string of = model.surfaces.size() == 1 ? "" : surface.name + ": ";
      const Program f = program == "pixel" ? drawn_function(model, i) : simplified(surface.f);
      text += fmt::format("# {}{}\n", of, to_text(choose_method(f, options.wish, options.kernel)));
    }
    return text;
  }

  std::optional<Program> pixel(const Model& model, std::vector<std::size_t> surfaces,
                               Diagnostics& diagnostics) const {
    RenderOptions picture;
    picture.surfaces = std::move(surfaces);
    picture.wish = options.wish;
    picture.limits = options.limits;
    picture.kernel = options.kernel;
    picture.economize = economize;
    return pixel_program(model, picture, diagnostics);
  }

  bool run(Diagnostics& diagnostics) const {
    Timings timings;
    const auto time = [&](const char* stage, const Stopwatch& watch) {
      timings.entries.push_back({stage, watch.milliseconds()});
    };
    const Stopwatch parsing;
    const auto model = read_model(file, diagnostics);
    if (!model) return false;
    time("parse", parsing);
    if (!uniform_values(*model, options.overrides, options.time, diagnostics)) return false;

    Output output;
    std::ostringstream between;
    PassTrace trace{
        .times = {}, .text = passes || !print_after.empty() ? &between : nullptr, .print_after = print_after};
    const bool all = passes && print_after.empty();
    const Stopwatch building;
    for (const Surface& surface : model->surfaces) {
      if (!options.surface.empty() && surface.name != options.surface) continue;
      if (all) between << "== as written\n" << to_text(surface.f);
      const Program f = program == "pixel" ? over_domain(*model, surface.f) : surface.f;
      if (all && !(f == surface.f)) between << "== specialize\n" << to_text(f);
      simplified(f, &trace);
    }
    auto built = build(*model, diagnostics);
    if (!built) return false;
    time("build program", building);
    if (const auto why = far_too_long(*built, longest))
      return diagnostics.error(why->span, why->message), false;
    if (all) between << "== before the passes of kernels\n" << to_text(*built);
    const Stopwatch lowering;
    const Program lowered = lower(*std::move(built), options.kernel, &trace);
    time("passes", lowering);

    const Stopwatch writing;
    output.text += between.str();
    if (emission || !trace.text) {
      auto text = emission ? emission->write(lowered, options) : emit_ir(lowered, options);
      if (!text) return diagnostics.error(text.error().span, text.error().message), false;
      output.text += *text;
    }
    if (!emission) output.text += methods_text(*model) + counts_text(lowered);
    if (passes) output.text += times_text(trace);
    if (!output.close(diagnostics)) return false;
    time("write", writing);
    print(timings, options);
    return true;
  }
};

}  // namespace

Action add_inspect(CLI::App& verb) {
  static const std::vector<Choice> emission_words = emission_choices();
  static const std::vector<Choice> program_words = program_choices();
  static const std::vector<Choice> pass_words = pass_choices();
  auto inspect = std::make_shared<Inspect>();
  verb.add_option("F.imp", inspect->file, "the file with the surface")->required()->type_name("");
  add_choice(verb, "--program", program_words, "what is shown (f)",
             [=](std::size_t i) { inspect->program = program_words[i].name; });
  verb.add_flag("--passes", inspect->passes, "after every pass that changed it, and what each one took");
  add_choice(verb, "--print-after", pass_words, "after this pass only",
             [=](std::size_t i) { inspect->print_after = pass_words[i].name; });
  add_choice(verb, "--emit", emission_words, "as LLVM IR, as assembly for --target, …",
             [=](std::size_t i) { inspect->emission = &emissions[i]; });
  add_economize(verb, inspect->economize);
  add_options(verb, inspect->options);
  verb.final_callback([=] { inspect->settle(); });
  return [inspect] {
    Diagnostics diagnostics;
    const bool done = inspect->run(diagnostics);
    print(diagnostics);
    return done ? fine : failed;
  };
}

}  // namespace imp::tools
