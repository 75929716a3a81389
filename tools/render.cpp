// imp render: a picture of a file's surfaces.
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <mutex>

#include <fmt/format.h>

#include "runtime/image.h"
#include "runtime/render.h"
#include "runtime/view.h"
#include "tools/input.h"
#include "tools/interrupt.h"
#include "tools/options.h"
#include "tools/report.h"
#include "tools/verbs.h"

namespace imp::tools {
namespace {

namespace fs = std::filesystem;

constexpr Choice thin_choices[] = {
    {"draw", "as if they were hits"},
    {"hide", "not at all"},
    {"mark", "in a colour of their own"},
};
constexpr Choice tile_choices[] = {{"on", "beams first"}, {"off", "every ray by itself"}};
constexpr Choice channel_choices[] = {{"depth", ""}, {"normal", ""}, {"steps", ""}, {"verdict", ""}};

// One line on a terminal, for what takes long.
class Progress {
 public:
  void show(double share) {
    if (!terminal_ || watch_.milliseconds() < next_) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock || watch_.milliseconds() < next_) return;
    next_ = watch_.milliseconds() + 100;
    shown_ = true;
    say(fmt::format("\rrendering {:3.0f} %", 100 * share));
  }
  ~Progress() {
    if (shown_) say(fmt::format("\r{:16}\r", ""));
  }

 private:
  const bool terminal_ = isatty(STDERR_FILENO) != 0;
  const Stopwatch watch_;
  std::atomic<double> next_ = 500;
  std::mutex mutex_;
  bool shown_ = false;
};

Image image_of(const Picture& picture, const RenderOptions& wanted) {
  Image image{picture.width, picture.height, {}};
  const auto add = [&](const char* name, const std::vector<float>& values, std::size_t first,
                       std::size_t stride) {
    image.channels.push_back({name, std::span(values).subspan(first), stride});
  };
  add("R", picture.color, 0, 3);
  add("G", picture.color, 1, 3);
  add("B", picture.color, 2, 3);
  if (wanted.depth) add("depth.Z", picture.depth, 0, 1);
  if (wanted.normal) {
    add("normal.X", picture.normal, 0, 3);
    add("normal.Y", picture.normal, 1, 3);
    add("normal.Z", picture.normal, 2, 3);
  }
  if (wanted.steps) add("steps", picture.steps, 0, 1);
  if (wanted.verdict) add("verdict", picture.verdict, 0, 1);
  return image;
}

// A smaller picture is done before the kernels of the tiles would be made.
constexpr std::size_t least_tiled_picture = 256 * 256;

struct Render {
  Options options;
  RenderOptions picture;
  std::string file, output;
  std::size_t repeat = 0;     // 0: not asked for
  std::optional<bool> tiles;  // nothing: where the picture is large enough
  unsigned threads = 0;       // 0: one a core

  void take_channels(const std::string& words) {
    picture.depth = picture.normal = picture.steps = picture.verdict = false;
    for (const std::string& word : CLI::detail::split(words, ',')) {
      bool* const wanted[] = {&picture.depth, &picture.normal, &picture.steps, &picture.verdict};
      *wanted[choose("--aov", word, channel_choices)] = true;
    }
  }

  // What can only be judged once all options are known.
  void settle() {
    picture.tiles = tiles.value_or(picture.width * picture.height >= least_tiled_picture);
    if (output.empty()) output = file == "-" ? "out.png" : fs::path(file).stem().string() + ".png";
    const std::string extension = image_extension(output);
    if (extension != ".png" && extension != ".exr")
      refuse("-o", fmt::format("'{}' is neither .png nor .exr", output));
    const bool further = picture.depth || picture.normal || picture.steps || picture.verdict;
    if (extension == ".png" && further)
      refuse("--aov", "a .png holds colours only; .exr holds further channels");
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
    if (!uniforms) return false;
    if (!check_view(*model, *uniforms, diagnostics)) return false;
    if (const auto problem = problem_with_output(output))  // it is better heard of now
      return diagnostics.error(*problem), false;

    RenderOptions all = picture;
    all.workers = std::make_shared<Workers>(threads);
    preload_image_module();
    all.kernel = options.kernel;
    all.wish = options.wish;
    all.limits = options.limits;
    all.steps = picture.steps || !options.stats.empty();
    const auto renderer = Renderer::make(*model, all, diagnostics, &timings);
    if (!renderer) return false;

    Picture result;
    std::vector<double> times;
    {
      Progress progress;
      const double frames = static_cast<double>(std::max<std::size_t>(repeat, 1));
      while (times.size() < std::max<std::size_t>(repeat, 1)) {
        const double done = static_cast<double>(times.size());
        const Stopwatch rendering;
        result = renderer->frame(
            *uniforms, {}, [&](double share) { progress.show((done + share) / frames); }, std::move(result));
        times.push_back(rendering.milliseconds());
      }
    }
    std::ranges::sort(times);
    const double median = times[times.size() / 2];
    timings.entries.push_back({"render", median});

    const Stopwatch writing;
    const auto problem = [&] {
      std::unique_lock<std::mutex> held;
      if (is_replaced(output)) held = hold_interrupts();  // a FIFO may never have a reader
      return write_image(output, image_of(result, picture));
    }();
    if (problem) return diagnostics.error(*problem), false;
    timings.entries.push_back({"image", writing.milliseconds()});

    if (repeat > 0)
      fmt::print(stderr, "{} frames: {:.2f} ms at least, {:.2f} in the median, {:.2f} at most\n",
                 times.size(), times.front(), median, times.back());
    Report report{"pixels", result.width * result.height, median, {}, {}, renderer->methods()};
    report.verdicts = {result.count(verdict_hit), result.count(verdict_miss),
                       result.count(verdict_undecided)};
    if (all.steps) report.steps = steps_of(std::span<const float>(result.steps));
    print(report, timings, options);
    return true;
  }
};

}  // namespace

Action add_render(CLI::App& verb) {
  auto render = std::make_shared<Render>();
  RenderOptions& picture = render->picture;
  verb.add_option("F.imp", render->file, "the file with the surfaces")->required()->type_name("");
  add_value(verb, "-o", "PATH", "the picture, .png or .exr; - is a .png on standard output (F.png)",
            [=](const std::string& path) { render->output = path; });
  add_size(verb, picture);
  add_choice(verb, "--thin", thin_choices, "how undecided pixels are drawn (draw)",
             [&picture](std::size_t i) { picture.thin = static_cast<Thin>(i); });
  add_choice(verb, "--tiles", tile_choices,
             "whether tiles of rays are searched together first (on from 256x256 pixels)",
             [=](std::size_t i) { render->tiles = i == 0; });
  add_value(verb, "--aov", "LIST", "further channels of an .exr, of depth,normal,steps,verdict",
            [=](const std::string& words) { render->take_channels(words); });
  add_economize(verb, picture.economize);
  add_value(verb, "--threads", "N", "how many work at once (one a core)", [=](const std::string& text) {
    render->threads = static_cast<unsigned>(read_count("--threads", text, 1, 1024));
  });
  add_value(verb, "--repeat", "N", "render N frames and print the milliseconds of one",
            [=](const std::string& text) { render->repeat = read_count("--repeat", text, 1, 1'000'000); });
  add_options(verb, render->options);
  verb.final_callback([=] { render->settle(); });
  return [render] {
    take_interrupts();
    Diagnostics diagnostics;
    const bool done = render->run(diagnostics);
    print(diagnostics);
    return done ? fine : failed;
  };
}

}  // namespace imp::tools
