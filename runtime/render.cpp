#include "runtime/render.h"

#include <algorithm>
#include <chrono>
#include <map>

#include "runtime/pixel.h"
#include "runtime/stages.h"
#include "runtime/view.h"

namespace imp {
namespace {

constexpr std::uint32_t tile = 64;

// Where an output of the pixel's Program goes.
struct Target {
  std::vector<float>* channel;
  std::size_t stride, offset;
};

std::map<std::string, Target> targets(Picture& picture) {
  return {{"red", {&picture.color, 3, 0}},       {"green", {&picture.color, 3, 1}},
          {"blue", {&picture.color, 3, 2}},      {"verdict", {&picture.verdict, 1, 0}},
          {"depth", {&picture.depth, 1, 0}},     {"normal.x", {&picture.normal, 3, 0}},
          {"normal.y", {&picture.normal, 3, 1}}, {"normal.z", {&picture.normal, 3, 2}},
          {"steps", {&picture.steps, 1, 0}}};
}

}  // namespace

std::size_t Picture::count(double which) const {
  return static_cast<std::size_t>(std::ranges::count(verdict, static_cast<float>(which)));
}

Renderer::Renderer(const Model& model, RenderOptions options, std::shared_ptr<const Kernel> kernel)
    : model_(&model), options_(std::move(options)), kernel_(std::move(kernel)) {
  if (!options_.workers) options_.workers = std::make_shared<Workers>();
}

std::optional<Renderer> Renderer::make(const Model& model, const RenderOptions& options,
                                       Diagnostics& diagnostics, Timings* timings) {
  const auto start = std::chrono::steady_clock::now();
  auto program = pixel_program(model, options, diagnostics);
  if (!program) return std::nullopt;
  if (timings)
    timings->entries.push_back(
        {"compose",
         std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count()});
  auto kernel = make_kernel(*std::move(program), options.kernel, timings);
  if (!kernel) {
    diagnostics.error(kernel.error().span, kernel.error().message);
    return std::nullopt;
  }
  return Renderer(model, options, *std::move(kernel));
}

Picture Renderer::frame(const UniformValues& uniforms, std::stop_token stop,
                        const std::function<void(double)>& progress) const {
  const FrameInputs inputs(*model_, uniforms, options_.width, options_.height);
  Picture picture{options_.width, options_.height, {}, {}, {}, {}, {}};
  std::vector<Target> channels;
  for (const Output& output : kernel_->program().outputs) {
    channels.push_back(targets(picture).at(output.name));
    channels.back().channel->resize(channels.back().stride * picture.width * picture.height);
  }
  std::ranges::fill(picture.verdict, static_cast<float>(verdict_undecided));  // until it is known

  const PixelSink sink = [&](const PixelRows& pixels) {
    for (std::size_t i = 0; i < pixels.count; ++i) {
      if (pixels.columns[i] >= picture.width || pixels.rows[i] >= picture.height) continue;
      const std::size_t place = pixels.rows[i] * picture.width + pixels.columns[i];
      for (std::size_t k = 0; k < channels.size(); ++k)
        (*channels[k].channel)[channels[k].stride * place + channels[k].offset] = pixels.outputs[k][i];
    }
  };
  const RunnableStage stage{{tile, tile, 1}, kernel_};
  run_stages(std::span(&stage, 1), {picture.width, picture.height}, std::cref(inputs), sink,
             *options_.workers, std::move(stop), progress);
  return picture;
}

}  // namespace imp
