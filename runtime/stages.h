// Runs a Pipeline over a picture: the tiles over all cores, the stages of a tile depth-first in one
// worker, so that a parent's rows are still in the cache when its children read them.
#pragma once

#include <functional>
#include <memory>
#include <stop_token>
#include <vector>

#include "backends/kernel.h"
#include "ir/stage.h"
#include "runtime/workers.h"

namespace imp {

// A stage with its Program made runnable.
struct RunnableStage {
  std::array<std::uint32_t, 3> cells{1, 1, 1};
  std::shared_ptr<const Kernel> kernel;
};

// The value of an input of rate frame, by name: where it lies, for as long as the picture is made.
using FrameValue = std::function<const void*(const Input&)>;

// Hears of the cells of the last stage, the pixels: for pixel i of `count` its place in the picture,
// and one column of floats an output. From many threads, never twice for one pixel.
struct PixelRows {
  std::size_t count;
  std::span<const std::uint32_t> columns, rows;
  std::span<const std::vector<float>> outputs;
};
using PixelSink = std::function<void(const PixelRows&)>;

// Hears, from many threads, of the pixels [x, x + width) × [y, y + height) that no stage needed.
using NotNeededSink =
    std::function<void(std::size_t x, std::size_t y, std::size_t width, std::size_t height)>;

struct PictureSize {
  std::size_t width, height;
};

// Outputs of all stages are f32.
void run_stages(std::span<const RunnableStage> stages, PictureSize size, const FrameValue& frame_value,
                const PixelSink& sink, const NotNeededSink& not_needed, Workers& workers,
                std::stop_token stop = {}, const std::function<void(double)>& progress = {});

// Some pixels of a picture by a Program for pixels, all by themselves.
void run_pixels(const RunnableStage& stage, std::span<const std::uint32_t> columns,
                std::span<const std::uint32_t> rows, const FrameValue& frame_value, const PixelSink& sink,
                Workers& workers, std::stop_token stop = {});

}  // namespace imp
