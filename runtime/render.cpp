#include "runtime/render.h"

#include <algorithm>
#include <atomic>
#include <expected>

#include "runtime/beam.h"
#include "runtime/canvas.h"
#include "runtime/pixel.h"
#include "runtime/stages.h"
#include "runtime/view.h"

namespace imp {
namespace {

constexpr std::uint32_t tile = 64;

// Beams whose Programs are longer take longer to compile than they save.
constexpr std::size_t most_beam_nodes = 8000;

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
    if (far_too_long(stage.program, options.kernel))
      return lowered_stages(model, options, false, diagnostics, timings);
    stage.program = lowered(std::move(stage.program));
    if (stage.program.graph.size() > most_beam_nodes)
      return lowered_stages(model, options, false, diagnostics, timings);
  }
  beams = !stages->empty();
  auto pixel = timed(timings, "compose", [&] { return pixel_program(model, options, diagnostics, beams); });
  if (!pixel) return std::nullopt;
  if (const auto why = far_too_long(*pixel, options.kernel)) {
    diagnostics.error(why->span, why->message);
    return std::nullopt;
  }
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
    result.push_back(choose_method(drawn_function(*model_, index), options_.wish, options_.kernel));
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
                        const std::function<void(double)>& progress, Picture used) const {
  const FrameInputs inputs(*model_, uniforms, options_.width, options_.height);
  Picture picture = std::move(used);
  picture.width = options_.width, picture.height = options_.height;
  Canvas canvas(picture, program().outputs);
  if (stop.stop_possible())  // then some may stay as they are
    std::ranges::fill(picture.verdict, static_cast<float>(verdict_undecided));

  run_stages(
      stages_, {picture.width, picture.height}, std::cref(inputs),
      [&](const PixelRows& pixels) { canvas.draw(pixels); },
      [&](std::size_t x, std::size_t y, std::size_t width, std::size_t height) {
        canvas.clear(x, y, width, height);
      },
      *options_.workers, stop, progress);
  const Undecided open = canvas.undecided();
  if (open.columns.empty() || stop.stop_requested()) return picture;
  if (in_double())
    run_pixels(
        {{1, 1, 1}, in_double_->kernel}, open.columns, open.rows, std::cref(inputs),
        [&](const PixelRows& pixels) { canvas.draw_decided(pixels); }, *options_.workers, stop);
  return picture;
}

}  // namespace imp
