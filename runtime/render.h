// Pictures of a Model.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <vector>

#include "frontend/model.h"
#include "runtime/kernel.h"
#include "runtime/method.h"
#include "runtime/numbers.h"
#include "runtime/search/search.h"
#include "runtime/stages.h"
#include "runtime/workers.h"

namespace imp {

enum class Thin : std::uint8_t { draw, hide, mark };  // how undecided pixels are drawn

struct RenderOptions {
  std::size_t width = 1024, height = 1024;
  std::vector<std::size_t> surfaces;  // indices into Model::surfaces; empty: all
  Wish wish;
  SearchLimits limits;
  std::optional<double> economize;  // see SearchSpace
  Thin thin = Thin::draw;
  bool tiles = true;  // whether beams are cast before rays (runtime/beam.h)
  bool depth = false, normal = false, steps = false, verdict = false;  // further channels
  bool ray = false;                  // and what a picture has no place for: see pixel_program
  std::shared_ptr<Workers> workers;  // null: a team of one thread a core
  KernelOptions kernel;
};

// Rows from the top. Colours are linear. Channels that were not asked for are empty, but for the
// verdicts, which are always there.
struct Picture {
  std::size_t width = 0, height = 0;
  std::vector<float> color;    // red, green, blue
  std::vector<float> verdict;  // 1 hit, 0 miss, -1 undecided
  std::vector<float> depth;    // distance from the eye; infinite where nothing was found
  std::vector<float> normal;   // x, y, z; 0 where nothing was found
  std::vector<float> steps;    // inclusions evaluated

  std::size_t count(double which) const;  // pixels with this verdict
};

// The kernel of a picture, made once and run for many frames: parameters, time, camera, lights and
// size are uniforms.
class Renderer {
 public:
  static std::optional<Renderer> make(const Model& model, const RenderOptions& options,
                                      Diagnostics& diagnostics, Timings* timings = nullptr);

  // Renders a frame; stops early, with what is done, when asked. `progress` hears, from any thread,
  // what share of the tiles is done. The memory of a picture that is no longer needed is taken again.
  Picture frame(const UniformValues& uniforms, std::stop_token stop = {},
                const std::function<void(double)>& progress = {}, Picture used = {}) const;

  // How each surface that is drawn is searched.
  std::vector<Method> methods() const;

  // Of a pixel.
  const Program& program() const { return stages_.back().kernel->program(); }

 private:
  Renderer(const Model& model, RenderOptions options, std::vector<RunnableStage> stages);

  // The same pixels in double, for those that floats leave undecided. Made when it is first needed.
  struct InDouble {
    std::once_flag made;
    std::shared_ptr<const Kernel> kernel;  // null: none is to be had
  };
  const Kernel* in_double() const;

  const Model* model_;
  RenderOptions options_;
  std::vector<RunnableStage> stages_;
  std::shared_ptr<InDouble> in_double_;  // null: not wanted
};

}  // namespace imp
