#include "runtime/render.h"

#include <algorithm>
#include <atomic>
#include <expected>
#include <limits>
#include <map>

#include "passes/surface_passes.h"
#include "runtime/beam.h"
#include "runtime/pixel.h"
#include "runtime/stages.h"
#include "runtime/view.h"

namespace imp {
namespace {

constexpr std::uint32_t tile = 64;

// Beams whose Programs are longer take longer to compile than they save.
constexpr std::size_t most_beam_nodes = 8000;

// Where an output of the pixel's Program goes.
struct Destination {
  std::vector<float>* channel;
  std::size_t stride, offset;
  float background;  // where nothing is
};

std::map<std::string, Destination> targets(Picture& picture) {
  constexpr float nowhere = std::numeric_limits<float>::infinity();
  const auto color = [&](std::size_t i) {
    return Destination{&picture.color, 3, i, static_cast<float>(background[i])};
  };
  return {{"red", color(0)},
          {"green", color(1)},
          {"blue", color(2)},
          {"verdict", {&picture.verdict, 1, 0, static_cast<float>(verdict_miss)}},
          {"depth", {&picture.depth, 1, 0, nowhere}},
          {"normal.x", {&picture.normal, 3, 0, 0}},
          {"normal.y", {&picture.normal, 3, 1, 0}},
          {"normal.z", {&picture.normal, 3, 2, 0}},
          {"steps", {&picture.steps, 1, 0, 0}}};
}

// The pixels of which nothing is certified.
struct Undecided {
  std::vector<std::uint32_t> columns, rows;

  explicit Undecided(const Picture& picture) {
    for (std::size_t i = 0; i < picture.verdict.size(); ++i)
      if (picture.verdict[i] == static_cast<float>(verdict_undecided)) {
        columns.push_back(static_cast<std::uint32_t>(i % picture.width));
        rows.push_back(static_cast<std::uint32_t>(i / picture.width));
      }
  }
};

// The stages as a backend gets them.
std::optional<Pipeline> lowered_stages(const Model& model, const RenderOptions& options, bool beams,
                                       Diagnostics& diagnostics, Timings* timings) {
  const auto lowered = [&](Program program) {
    return timed(timings, "passes", [&] { return lower(std::move(program), options.kernel); });
  };
  auto stages = timed(timings, "compose",
                      [&] { return beams ? beam_stages(model, options, diagnostics) : Pipeline{}; });
  if (!stages) return std::nullopt;
  for (Stage& stage : *stages) {
    stage.program = lowered(std::move(stage.program));
    if (stage.program.graph.size() > most_beam_nodes)
      return lowered_stages(model, options, false, diagnostics, timings);
  }
  beams = !stages->empty();
  auto pixel = timed(timings, "compose", [&] { return pixel_program(model, options, diagnostics, beams); });
  if (!pixel) return std::nullopt;
  const std::uint32_t side = beams ? beam_cell : tile;
  stages->push_back({{side, side, 1}, lowered(*std::move(pixel))});
  return stages;
}

// All at once, by all workers.
std::expected<std::vector<RunnableStage>, Refusal> compiled(Pipeline stages, const KernelOptions& options,
                                                            Workers& workers) {
  std::vector<std::expected<std::unique_ptr<Kernel>, Refusal>> kernels(stages.size());
  std::atomic<std::size_t> next = 0;
  workers.run([&] {
    for (std::size_t i = next++; i < stages.size(); i = next++)
      kernels[i] = make_lowered_kernel(std::move(stages[i].program), options);
  });
  std::vector<RunnableStage> result;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    if (!kernels[i]) return std::unexpected(std::move(kernels[i].error()));
    result.push_back({stages[i].cells, *std::move(kernels[i])});
  }
  return result;
}

}  // namespace

std::size_t Picture::count(double which) const {
  return static_cast<std::size_t>(std::ranges::count(verdict, static_cast<float>(which)));
}

Renderer::Renderer(const Model& model, RenderOptions options, std::vector<RunnableStage> stages)
    : model_(&model), options_(std::move(options)), stages_(std::move(stages)) {
  if (std::ranges::any_of(methods(), &Method::again)) in_double_ = std::make_shared<InDouble>();
}

std::vector<Method> Renderer::methods() const {
  std::vector<Method> result;
  for (const std::size_t index : drawn_surfaces(*model_, options_))
    result.push_back(choose_method(simplified(model_->surfaces[index].f), options_.wish, options_.kernel));
  return result;
}

const Kernel* Renderer::in_double() const {
  if (!in_double_) return nullptr;
  std::call_once(in_double_->made, [&] {
    RenderOptions options = options_;
    options.kernel.precision = f64;
    options.wish = second_wish(options.wish);
    Diagnostics unused;
    auto pixel = pixel_program(*model_, options, unused);
    if (!pixel) return;
    auto kernel = make_kernel(*std::move(pixel), options.kernel);
    if (kernel) in_double_->kernel = *std::move(kernel);
  });
  return in_double_->kernel.get();
}

std::optional<Renderer> Renderer::make(const Model& model, const RenderOptions& options,
                                       Diagnostics& diagnostics, Timings* timings) {
  auto stages = lowered_stages(model, options, options.tiles, diagnostics, timings);
  if (!stages) return std::nullopt;
  RenderOptions shared = options;
  if (!shared.workers) shared.workers = std::make_shared<Workers>();
  auto kernels = timed(timings, "compile",
                       [&] { return compiled(*std::move(stages), options.kernel, *shared.workers); });
  if (!kernels) {
    diagnostics.error(kernels.error().span, kernels.error().message);
    return std::nullopt;
  }
  return Renderer(model, std::move(shared), *std::move(kernels));
}

Picture Renderer::frame(const UniformValues& uniforms, std::stop_token stop,
                        const std::function<void(double)>& progress) const {
  const FrameInputs inputs(*model_, uniforms, options_.width, options_.height);
  Picture picture{options_.width, options_.height, {}, {}, {}, {}, {}};
  std::vector<Destination> channels;
  for (const Output& output : program().outputs) {
    channels.push_back(targets(picture).at(output.name));
    channels.back().channel->resize(channels.back().stride * picture.width * picture.height);
  }
  std::ranges::fill(picture.verdict, static_cast<float>(verdict_undecided));  // until it is known

  const auto pixel = [&](std::size_t k, std::size_t place) -> float& {
    return (*channels[k].channel)[channels[k].stride * place + channels[k].offset];
  };
  const PixelSink sink = [&](const PixelRows& pixels) {
    for (std::size_t i = 0; i < pixels.count; ++i) {
      if (pixels.columns[i] >= picture.width || pixels.rows[i] >= picture.height) continue;
      const std::size_t place = pixels.rows[i] * picture.width + pixels.columns[i];
      for (std::size_t k = 0; k < channels.size(); ++k) pixel(k, place) = pixels.outputs[k][i];
    }
  };
  // What is decided, with the steps of both looks.
  const PixelSink second_sink = [&](const PixelRows& pixels) {
    const auto channel_of = [&](const std::vector<float>& data) {
      const auto found = std::ranges::find(channels, &data, &Destination::channel);
      return static_cast<std::size_t>(found - channels.begin());
    };
    const std::size_t verdict = channel_of(picture.verdict), steps = channel_of(picture.steps);
    for (std::size_t i = 0; i < pixels.count; ++i) {
      const std::size_t place = pixels.rows[i] * picture.width + pixels.columns[i];
      const bool decided = pixels.outputs[verdict][i] != static_cast<float>(verdict_undecided);
      for (std::size_t k = 0; k < channels.size(); ++k) {
        if (k == steps)
          pixel(k, place) += pixels.outputs[k][i];
        else if (decided)
          pixel(k, place) = pixels.outputs[k][i];
      }
    }
  };
  // Where all is excluded.
  const NotNeededSink not_needed = [&](std::size_t x, std::size_t y, std::size_t width, std::size_t height) {
    for (const Destination& target : channels)
      for (std::size_t row = y; row < y + height; ++row)
        for (std::size_t place = row * picture.width + x; place < row * picture.width + x + width; ++place)
          (*target.channel)[target.stride * place + target.offset] = target.background;
  };
  run_stages(stages_, {picture.width, picture.height}, std::cref(inputs), sink, not_needed, *options_.workers,
             stop, progress);
  const Undecided open(picture);
  if (open.columns.empty() || stop.stop_requested()) return picture;
  if (in_double())
    run_pixels({{1, 1, 1}, in_double_->kernel}, open.columns, open.rows, std::cref(inputs), second_sink,
               *options_.workers, stop);
  return picture;
}

}  // namespace imp
