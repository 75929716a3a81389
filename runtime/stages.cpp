#include "runtime/stages.h"

#include <algorithm>
#include <atomic>
#include <optional>

#include "ir/assert.h"

namespace imp {
namespace {

constexpr std::uint32_t block = 4;  // cells are visited in blocks, as rays of a packet should be near

// The cells of one parent, in the order of the lanes: slabs of a cell lie together.
struct Lanes {
  std::vector<float> column, row, slab;

  std::size_t size() const { return column.size(); }
};

Lanes lanes_of(const std::array<std::uint32_t, 3>& cells) {
  const auto [columns, rows, slabs] = cells;
  Lanes lanes;
  for (std::uint32_t j = 0; j < rows; j += block)
    for (std::uint32_t i = 0; i < columns; i += block)
      for (std::uint32_t y = j; y < std::min(j + block, rows); ++y)
        for (std::uint32_t x = i; x < std::min(i + block, columns); ++x)
          for (std::uint32_t z = 0; z < slabs; ++z) {
            lanes.column.push_back(static_cast<float>(x));
            lanes.row.push_back(static_cast<float>(y));
            lanes.slab.push_back(static_cast<float>(z));
          }
  return lanes;
}

// What one worker keeps for one stage.
struct Level {
  Level(const RunnableStage& of_stage, Lanes of_lanes) : stage(&of_stage), lanes(std::move(of_lanes)) {}

  const RunnableStage* stage;
  Lanes lanes;
  std::array<std::uint32_t, 2> cell_pixels{1, 1};  // the size of one cell, in pixels
  std::vector<const void*> inputs;
  std::vector<void*> outputs;
  std::vector<std::vector<float>> rows;
  std::optional<std::size_t> needed;  // the output of this name
  float x0 = 0, y0 = 0;
};

// Tells the kernel of a level where its inputs lie, but for tables of a parent, and where its outputs go.
void bind(Level& level, const FrameValue& frame_value) {
  level.inputs.clear();
  level.outputs.clear();
  level.rows.clear();
  const Program& program = level.stage->kernel->program();
  for (const Input& input : program.inputs) {
    const void* data = nullptr;
    if (input.rate == Rate::frame)
      data = frame_value(input);  // first: a parameter may have any name
    else if (input.name == "column")
      data = level.lanes.column.data();
    else if (input.name == "row")
      data = level.lanes.row.data();
    else if (input.name == "slab")
      data = level.lanes.slab.data();
    else if (input.name == "x0")
      data = &level.x0;
    else if (input.name == "y0")
      data = &level.y0;
    level.inputs.push_back(data);
  }
  for (const Output& output : program.outputs) {
    IMP_ASSERT(program.graph[output.id].type == f32, "outputs of type f32");
    if (output.name == "needed") level.needed = level.rows.size();
    level.outputs.push_back(level.rows.emplace_back(level.lanes.size()).data());
  }
}

class Worker {
 public:
  Worker(std::span<const RunnableStage> stages, PictureSize size, const FrameValue& frame_value,
         const PixelSink& sink, const NotNeededSink& not_needed)
      : size_(size), sink_(sink), not_needed_(not_needed) {
    levels_.reserve(stages.size());
    for (const RunnableStage& stage : stages) levels_.emplace_back(stage, lanes_of(stage.cells));
    for (std::size_t i = levels_.size() - 1; i-- > 0;)
      for (std::size_t axis = 0; axis < 2; ++axis)
        levels_[i].cell_pixels[axis] = levels_[i + 1].cell_pixels[axis] * stages[i + 1].cells[axis];
    for (Level& level : levels_) bind(level, frame_value);
    tile_ = {levels_[0].cell_pixels[0] * stages[0].cells[0], levels_[0].cell_pixels[1] * stages[0].cells[1]};
  }

  std::array<std::uint32_t, 2> tile() const { return tile_; }

  // Every cell of level i below the parent whose first pixel is (x, y) and whose rows begin at
  // `parent` in the level above.
  void run(std::size_t i, std::uint32_t x, std::uint32_t y, std::size_t parent) {
    Level& level = levels_[i];
    level.x0 = static_cast<float>(x);
    level.y0 = static_cast<float>(y);
    const Program& program = level.stage->kernel->program();
    for (std::size_t k = 0; k < program.inputs.size(); ++k)
      if (program.inputs[k].type.is_table() && program.inputs[k].rate == Rate::cell)
        level.inputs[k] = parent_rows(i, program.inputs[k]).data() + parent;
    level.stage->kernel->run({level.lanes.size(), level.inputs, level.outputs});
    if (i + 1 == levels_.size()) return deliver(level, x, y);

    const std::size_t slabs = level.stage->cells[2];
    for (std::size_t lane = 0; lane < level.lanes.size(); lane += slabs) {
      const auto column = static_cast<std::uint32_t>(level.lanes.column[lane]);
      const auto row = static_cast<std::uint32_t>(level.lanes.row[lane]);
      const std::uint32_t cx = x + column * level.cell_pixels[0], cy = y + row * level.cell_pixels[1];
      if (cx >= size_.width || cy >= size_.height) continue;
      if (is_needed(level, lane))
        run(i + 1, cx, cy, lane);
      else
        not_needed_(cx, cy, std::min<std::size_t>(level.cell_pixels[0], size_.width - cx),
                    std::min<std::size_t>(level.cell_pixels[1], size_.height - cy));
    }
  }

 private:
  static bool is_needed(const Level& level, std::size_t lane) {
    if (!level.needed) return true;
    const auto begin = level.rows[*level.needed].begin() + static_cast<std::ptrdiff_t>(lane);
    return std::any_of(begin, begin + level.stage->cells[2], [](float needed) { return needed != 0; });
  }

  const std::vector<float>& parent_rows(std::size_t i, const Input& table) const {
    IMP_ASSERT(i > 0, "a stage above the one that reads a table");
    const Program& above = levels_[i - 1].stage->kernel->program();
    const Output* output = above.output(table.name);
    IMP_ASSERT(output && table.type.length == levels_[i - 1].stage->cells[2],
               "the parent's output, over its slabs");
    return levels_[i - 1].rows[static_cast<std::size_t>(output - above.outputs.data())];
  }

  void deliver(const Level& level, std::uint32_t x, std::uint32_t y) {
    columns_.resize(level.lanes.size());
    rows_.resize(level.lanes.size());
    for (std::size_t lane = 0; lane < level.lanes.size(); ++lane) {
      columns_[lane] = x + static_cast<std::uint32_t>(level.lanes.column[lane]);
      rows_[lane] = y + static_cast<std::uint32_t>(level.lanes.row[lane]);
    }
    sink_({level.lanes.size(), columns_, rows_, level.rows});
  }

  PictureSize size_;
  const PixelSink& sink_;
  const NotNeededSink& not_needed_;
  std::vector<Level> levels_;
  std::array<std::uint32_t, 2> tile_{};
  std::vector<std::uint32_t> columns_, rows_;
};

}  // namespace

void run_pixels(const RunnableStage& stage, std::span<const std::uint32_t> columns,
                std::span<const std::uint32_t> rows, const FrameValue& frame_value, const PixelSink& sink,
                Workers& workers, std::stop_token stop) {
  constexpr std::size_t at_once = 256;
  std::atomic<std::size_t> next = 0;
  workers.run([&] {
    Level level(stage, Lanes{});
    while (!stop.stop_requested()) {
      const std::size_t begin = at_once * next.fetch_add(1);
      if (begin >= columns.size()) break;
      const std::size_t count = std::min(at_once, columns.size() - begin);
      const auto some_columns = columns.subspan(begin, count), some_rows = rows.subspan(begin, count);
      level.lanes = {{some_columns.begin(), some_columns.end()},
                     {some_rows.begin(), some_rows.end()},
                     std::vector<float>(count)};
      bind(level, frame_value);
      level.stage->kernel->run({count, level.inputs, level.outputs});
      sink({count, some_columns, some_rows, level.rows});
    }
  });
}

void run_stages(std::span<const RunnableStage> stages, PictureSize size, const FrameValue& frame_value,
                const PixelSink& sink, const NotNeededSink& not_needed, Workers& workers,
                std::stop_token stop, const std::function<void(double)>& progress) {
  IMP_ASSERT(!stages.empty(), "at least one stage");
  std::atomic<std::size_t> next = 0;
  workers.run([&] {
    Worker worker(stages, size, frame_value, sink, not_needed);
    const auto [tile_width, tile_height] = worker.tile();
    const std::size_t across = (size.width + tile_width - 1) / tile_width;
    const std::size_t tiles = across * ((size.height + tile_height - 1) / tile_height);
    while (!stop.stop_requested()) {
      const std::size_t tile = next.fetch_add(1);
      if (tile >= tiles) break;
      worker.run(0, static_cast<std::uint32_t>(tile % across * tile_width),
                 static_cast<std::uint32_t>(tile / across * tile_height), 0);
      if (progress) progress(static_cast<double>(tile + 1) / static_cast<double>(tiles));
    }
  });
}

}  // namespace imp
