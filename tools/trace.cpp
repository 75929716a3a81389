// imp trace: what the search did for one pixel of a picture, step by step.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "runtime/pixel_trace.h"
#include "runtime/view.h"
#include "tools/input.h"
#include "tools/options.h"
#include "tools/report.h"
#include "tools/text_table.h"
#include "tools/verbs.h"

namespace imp::tools {
namespace {

// 512,384
PixelPlace read_pixel(const std::string& text) {
  constexpr std::string_view option = "--pixel";
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos) refuse(option, fmt::format("'{}' is not of the form X,Y", text));
  constexpr std::size_t most = 65535;
  return {read_count(option, std::string_view(text).substr(0, comma), 0, most),
          read_count(option, std::string_view(text).substr(comma + 1), 0, most)};
}

std::string vector_text(const PixelTrace& trace, const std::string& name) {
  return fmt::format("({}, {}, {})", trace.answer.at(name + ".x"), trace.answer.at(name + ".y"),
                     trace.answer.at(name + ".z"));
}

std::string state_text(Type type, double value) {
  if (type == truth) return value != 0 ? "yes" : "no";
  return type.scalar == Scalar::f32 ? fmt::format("{}", static_cast<float>(value)) : fmt::format("{}", value);
}

// The piece of the ray that a step looks at: strategies call its beginning s and its length h, as
// shares of the segment.
struct Piece {
  std::size_t s, h;  // places of these states among those of a phase; their count where missing

  explicit Piece(const Phase& phase) : s(place(phase, "s")), h(place(phase, "h")) {}
  static std::size_t place(const Phase& phase, std::string_view name) {
    return static_cast<std::size_t>(std::ranges::find(phase.states, name, &State::name) -
                                    phase.states.begin());
  }
};

// One row a step. Beside the states: t, the distance from where the ray begins; t end, that of the end
// of the piece; depth, how often the segment was halved to get it.
Table table_of(const PixelTrace& trace, std::size_t phase_index, std::span<const TraceStep> steps) {
  const Phase& phase = trace.program.phases[phase_index];
  const Piece piece(phase);
  const bool has_t = piece.s < phase.states.size(), has_piece = has_t && piece.h < phase.states.size();
  const double near = trace.answer.at("near"), far = trace.answer.at("far");
  const auto t = [&](double s) { return fmt::format("{:.9g}", near + s * (far - near)); };

  Row head{"step"};
  if (has_t) head.emplace_back("t");
  if (has_piece) head.insert(head.end(), {"t end", "depth"});
  for (const State& state : phase.states)
    if (state.type.length == 0) head.push_back(state.name);
  Table table{head};
  for (const TraceStep& step : steps) {
    Row row{step.again ? std::to_string(step.step) : "end"};
    if (has_t) row.push_back(t(step.states[piece.s]));
    if (has_piece) {
      row.push_back(t(step.states[piece.s] + step.states[piece.h]));
      row.push_back(fmt::format("{:g}", std::log2(1 / step.states[piece.h])));
    }
    std::size_t place = 0;
    for (const State& state : phase.states) {
      if (state.type.length == 0) row.push_back(state_text(state.type, step.states[place]));
      place += std::max<std::size_t>(state.type.length, 1);
    }
    table.push_back(std::move(row));
  }
  return table;
}

std::string phases_text(const PixelTrace& trace) {
  std::string text;
  for (auto begin = trace.steps.begin(); begin != trace.steps.end();) {
    const std::size_t index = begin->phase;
    const auto end =
        std::find_if(begin, trace.steps.end(), [&](const TraceStep& step) { return step.phase != index; });
    const Phase& phase = trace.program.phases[index];
    const std::uint32_t count = std::prev(end)->step;
    if (count == 0)
      text += fmt::format("\n{}: not entered\n", phase.name);
    else
      text += fmt::format("\n{}: {} step{}{}\n{}", phase.name, count, count == 1 ? "" : "s",
                          count == phase.steps ? ", the most there may be" : "",
                          to_text(table_of(trace, index, {begin, end}), Align::numbers, "  "));
    begin = end;
  }
  return text;
}

std::string answer_text(const PixelTrace& trace) {
  const auto at = [&](const char* name) { return trace.answer.at(name); };
  const bool in_domain = at("near") < at("far");
  const bool something = std::isfinite(at("depth"));
  const char* verdict = at("verdict") == verdict_hit    ? "hit: the first root, certified"
                        : at("verdict") != verdict_miss ? "undecided"
                        : in_domain                     ? "miss: every piece is excluded, certified"
                                                        : "miss: the ray does not meet the domain";
  std::string text =
      fmt::format("\nverdict   {}{}\n", verdict,
                  at("verdict") == verdict_undecided && !something ? ": nothing was found" : "");
  if (something) {
    const auto place = [&](const std::string& axis) {
      return trace.answer.at("origin." + axis) + at("depth") * trace.answer.at("direction." + axis);
    };
    text += fmt::format("t         {}\nposition  ({}, {}, {})\nnormal    {}\n", at("depth"), place("x"),
                        place("y"), place("z"), vector_text(trace, "normal"));
  }
  return text + fmt::format("steps     {}\n", at("steps"));
}

struct Trace {
  Options options;
  RenderOptions picture;
  std::string file;
  PixelPlace pixel;

  void settle() const {
    if (pixel.column >= picture.width || pixel.row >= picture.height)
      refuse("--pixel", fmt::format("{},{} is not in a picture of {}x{}; they count from 0,0, the upper left",
                                    pixel.column, pixel.row, picture.width, picture.height));
  }

  bool run(Diagnostics& diagnostics) {
    Timings timings;
    const Stopwatch parsing;
    const auto model = read_model(file, diagnostics);
    if (!model) return false;
    timings.entries.push_back({"parse", parsing.milliseconds()});
    if (!options.surface.empty()) {
      const auto surface = choose_surface(*model, options.surface, diagnostics);
      if (!surface) return false;
      picture.surfaces = {*surface};
    }
    const auto uniforms = uniform_values(*model, options.overrides, options.time, diagnostics);
    if (!uniforms || !check_view(*model, *uniforms, diagnostics)) return false;

    const Stopwatch tracing;
    options.kernel.backend = Backend::interpreter;
    picture.kernel = options.kernel;
    picture.wish = options.wish;
    picture.limits = options.limits;
    const auto trace = trace_pixel(*model, picture, *uniforms, pixel, diagnostics);
    if (!trace) return false;
    const double milliseconds = tracing.milliseconds();
    timings.entries.push_back({"trace", milliseconds});

    const float near = trace->answer.at("near"), far = trace->answer.at("far");
    Output output;
    output.text =
        fmt::format("pixel     {},{} of {}x{}\nray       {} + t {}\n", pixel.column, pixel.row, picture.width,
                    picture.height, vector_text(*trace, "origin"), vector_text(*trace, "direction"));
    if (near < far) output.text += fmt::format("segment   t = {} to {}\n", near, far);
    output.text += phases_text(*trace) + answer_text(*trace);
    if (!output.close(diagnostics)) return false;

    const float verdict = trace->answer.at("verdict"), steps = trace->answer.at("steps");
    Report report{"pixels", 1, milliseconds, Verdicts{}, Steps{steps, steps}, {}};
    (verdict == verdict_hit    ? report.verdicts->hit
     : verdict == verdict_miss ? report.verdicts->miss
                               : report.verdicts->undecided) = 1;
    print(report, timings, options);
    return true;
  }
};

}  // namespace

Action add_trace(CLI::App& verb) {
  auto trace = std::make_shared<Trace>();
  verb.add_option("F.imp", trace->file, "the file with the surfaces")->required()->type_name("");
  add_value(verb, "--pixel", "X,Y", "the pixel, counted from 0,0, the upper left",
            [=](const std::string& text) { trace->pixel = read_pixel(text); })
      ->required();
  add_size(verb, trace->picture);
  add_economize(verb, trace->picture.economize);
  add_options(verb, trace->options);
  verb.final_callback([=] { trace->settle(); });
  return [trace] {
    Diagnostics diagnostics;
    const bool done = trace->run(diagnostics);
    print(diagnostics);
    return done ? fine : failed;
  };
}

}  // namespace imp::tools
