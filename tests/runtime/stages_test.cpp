// Stages: every cell hears where it is and what its parent found, and every pixel is made once.
#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <mutex>

#include "ir/text.h"
#include "runtime/kernel.h"
#include "runtime/stages.h"
#include "tests/support/shader.h"

namespace imp {
namespace {

// A number for each cell of a tile's grid of 4 x 4 cells in 3 slabs, then each pixel's place beside
// what its cell has for the first and the last slab.
const char* const two_stages = R"(
stage 4 4 3
program coarse
  input frame base: f32
  input cell x0: f32
  input cell y0: f32
  input ray column: f32
  input ray row: f32
  input ray slab: f32
  %a = mul %row 4f
  %b = mul %slab 16f
  %c = mul %x0 64f
  %d = mul %y0 4096f
  %e = add %a %column
  %f = add %e %b
  %g = add %f %c
  %h = add %g %d
  %i = add %h %base
  output other = %column
  output code = %i
end

stage 8 8 1
program fine
  input cell x0: f32
  input cell y0: f32
  input cell code: f32[3]
  input ray row: f32
  input ray column: f32
  input frame scale_in: f64
  %x = add %x0 %column
  %y = add %y0 %row
  %scale = narrow %scale_in
  %near = load %code 0f
  %far = load %code 2f
  %big = mul %far %scale
  output x = %x
  output y = %y
  output near = %near
  output far = %big
end
)";

constexpr float base = 0.5F;
constexpr double scale = 2;

struct Pixel {
  float x, y, near, far;
  friend bool operator==(const Pixel&, const Pixel&) = default;
};

Pixel predicted(std::uint32_t x, std::uint32_t y) {
  const auto code = [&](std::uint32_t slab) {
    const std::uint32_t column = x % 32 / 8, row = y % 32 / 8;
    return base +
           static_cast<float>(column + 4 * row + 16 * slab + 64 * (x / 32 * 32) + 4096 * (y / 32 * 32));
  };
  return {static_cast<float>(x), static_cast<float>(y), code(0), 2 * code(2)};
}

Pipeline pipeline_of(std::string text) {
  Diagnostics diagnostics;
  auto pipeline = parse_pipeline(std::move(text), "test", diagnostics);
  EXPECT_TRUE(pipeline.has_value()) << to_text(diagnostics);
  return pipeline.value();
}

std::vector<RunnableStage> runnable(const Pipeline& pipeline, Backend backend) {
  std::vector<RunnableStage> stages;
  for (const Stage& stage : pipeline) {
    auto kernel = make_kernel(stage.program, {.backend = backend});
    EXPECT_TRUE(kernel.has_value()) << kernel.error().message;
    stages.push_back({stage.cells, std::move(kernel).value()});
  }
  return stages;
}

const void* frame_value(const Input& input) {
  return input.name == "base" ? static_cast<const void*>(&base) : &scale;
}

void nowhere(std::size_t, std::size_t, std::size_t, std::size_t) { ADD_FAILURE() << "every cell is needed"; }

class Stages : public testing::TestWithParam<Backend> {};

TEST_P(Stages, children_read_what_their_parent_found) {
  if (GetParam() == Backend::glsl) IMP_NEEDS_GL();
  const auto stages = runnable(pipeline_of(two_stages), GetParam());
  for (const PictureSize size : {PictureSize{32, 32}, {1, 1}, {33, 17}, {70, 65}, {128, 3}})
    for (const unsigned threads : {1u, 2u, 5u}) {
      SCOPED_TRACE(testing::Message() << size.width << " x " << size.height << ", threads: " << threads);
      std::mutex mutex;
      std::map<std::pair<std::uint32_t, std::uint32_t>, Pixel> pixels;
      const PixelSink sink = [&](const PixelRows& rows) {
        const std::scoped_lock lock(mutex);
        for (std::size_t i = 0; i < rows.count; ++i) {
          const Pixel pixel{rows.outputs[0][i], rows.outputs[1][i], rows.outputs[2][i], rows.outputs[3][i]};
          EXPECT_TRUE(pixels.insert({{rows.columns[i], rows.rows[i]}, pixel}).second) << "made twice";
        }
      };
      Workers workers(threads);
      run_stages(stages, size, frame_value, sink, nowhere, workers);
      for (std::uint32_t y = 0; y < size.height; ++y)
        for (std::uint32_t x = 0; x < size.width; ++x) {
          const auto it = pixels.find({x, y});
          ASSERT_NE(it, pixels.end()) << x << ", " << y << " is missing";
          ASSERT_EQ(it->second, predicted(x, y)) << x << ", " << y;
        }
    }
}

// A table of one slab, through a stage in the middle.
TEST_P(Stages, three_of_them) {
  const auto stages = runnable(pipeline_of(R"(
stage 2 1 2
program first
  input ray column: f32
  input ray slab: f32
  %ten = mul %column 10f
  %both = add %ten %slab
  output found = %both
end

stage 3 2 1
program second
  input cell found: f32[2]
  input ray column: f32
  %far = load %found 1f
  %hundred = mul %column 100f
  %sum = add %far %hundred
  output sum = %sum
end

stage 5 7 1
program third
  input cell sum: f32[1]
  %it = load %sum 0f
  output it = %it
end
)"),
                               GetParam());
  std::atomic<int> pixels = 0;
  const PixelSink sink = [&](const PixelRows& rows) {
    for (std::size_t i = 0; i < rows.count; ++i) {
      const std::uint32_t x = rows.columns[i] % 30;  // a tile is 2*3*5 by 1*2*7
      ASSERT_EQ(rows.outputs[0][i], static_cast<float>(1 + 10 * (x / 15) + 100 * (x % 15 / 5)));
      ++pixels;
    }
  };
  Workers workers(2);
  run_stages(stages, {60, 14}, frame_value, sink, nowhere, workers);
  EXPECT_EQ(pixels, 60 * 14);
}

// Cells of 8 x 8 pixels in two slabs; needed where a slab says so: column 1 in slab 0, row 2 in slab 1.
TEST_P(Stages, below_a_cell_that_is_not_needed_do_not_run) {
  if (GetParam() == Backend::glsl) IMP_NEEDS_GL();
  const auto stages = runnable(pipeline_of(R"(
stage 4 4 2
program first
  input ray column: f32
  input ray row: f32
  input ray slab: f32
  %first = eq %slab 0f
  %one = eq %column 1f
  %two = eq %row 2f
  %a = and %first %one
  %second = not %first
  %b = and %second %two
  %any = or %a %b
  %needed = select %any 1f 0f
  output needed = %needed
end

stage 8 8 1
program pixel
  input cell x0: f32
  output x0 = %x0
end
)"),
                               GetParam());
  constexpr std::size_t width = 60, height = 30;
  std::mutex mutex;
  std::map<std::pair<std::size_t, std::size_t>, bool> ran;
  const auto note = [&](std::size_t x, std::size_t y, bool run) {
    EXPECT_TRUE(ran.insert({{x, y}, run}).second) << "heard of twice";
  };
  const PixelSink sink = [&](const PixelRows& rows) {
    const std::scoped_lock lock(mutex);
    for (std::size_t i = 0; i < rows.count; ++i)
      if (rows.columns[i] < width && rows.rows[i] < height) note(rows.columns[i], rows.rows[i], true);
  };
  const NotNeededSink not_needed = [&](std::size_t x, std::size_t y, std::size_t w, std::size_t h) {
    const std::scoped_lock lock(mutex);
    for (std::size_t j = y; j < y + h; ++j)
      for (std::size_t i = x; i < x + w; ++i) note(i, j, false);
  };
  Workers workers(2);
  run_stages(stages, {width, height}, frame_value, sink, not_needed, workers);
  ASSERT_EQ(ran.size(), width * height);
  for (const auto& [place, run] : ran)
    EXPECT_EQ(run, place.first / 8 % 4 == 1 || place.second / 8 % 4 == 2)
        << place.first << ", " << place.second;
}

INSTANTIATE_TEST_SUITE_P(Backends, Stages,
                         testing::Values(Backend::interpreter, Backend::llvm, Backend::glsl),
                         [](const auto& test) {
                           return test.param == Backend::llvm   ? "llvm"
                                  : test.param == Backend::glsl ? "glsl"
                                                                : "interpreter";
                         });

TEST(Stages, stop_when_asked) {
  const auto stages = runnable(pipeline_of(two_stages), Backend::llvm);
  std::stop_source stop;
  std::atomic<std::size_t> pixels = 0;
  const PixelSink sink = [&](const PixelRows& rows) {
    pixels += rows.count;
    stop.request_stop();
  };
  Workers workers(1);
  run_stages(stages, {640, 640}, frame_value, sink, nowhere, workers, stop.get_token());
  EXPECT_EQ(pixels, 32 * 32U);  // a tile that was begun is finished
}

TEST(Stages, tell_how_far_they_are) {
  const auto stages = runnable(pipeline_of(two_stages), Backend::llvm);
  std::vector<double> heard;
  Workers workers(1);
  run_stages(
      stages, {64, 64}, frame_value, [](const PixelRows&) {}, nowhere, workers, {},
      [&](double share) { heard.push_back(share); });
  EXPECT_EQ(heard, (std::vector{0.25, 0.5, 0.75, 1.0}));
}

}  // namespace
}  // namespace imp
