#include "runtime/stages.h"

#include <atomic>

#include "ir/assert.h"

namespace imp {
namespace {

constexpr std::uint32_t block = 4;  // cells are visited in blocks, as rays of a packet should be near

// The cells of one parent, in the order of the lanes: slabs of a cell lie together.
struct Lanes {
  std::vector<float> column, row, slab;

  explicit Lanes(const std::array<std::uint32_t, 3>& cells) {
    const auto [columns, rows, slabs] = cells;
    for (std::uint32_t j = 0; j < rows; j += block)
      for (std::uint32_t i = 0; i < columns; i += block)
        for (std::uint32_t y = j; y < std::min(j + block, rows); ++y)
          for (std::uint32_t x = i; x < std::min(i + block, columns); ++x)
            for (std::uint32_t z = 0; z < slabs; ++z) {
              column.push_back(static_cast<float>(x));
              row.push_back(static_cast<float>(y));
              slab.push_back(static_cast<float>(z));
            }
  }
  std::size_t size() const { return column.size(); }
};

// What one worker keeps for one stage.
struct Level {
  const RunnableStage* stage;
  Lanes lanes;
  std::array<std::uint32_t, 2> cell_pixels;  // the size of one cell, in pixels
  std::vector<const void*> inputs;
  std::vector<void*> outputs;
  std::vector<std::vector<float>> rows;
  float x0 = 0, y0 = 0;
};

class Worker {
 public:
  Worker(std::span<const RunnableStage> stages, PictureSize size, const FrameValue& frame_value,
         const PixelSink& sink)
      : size_(size), sink_(sink) {
    levels_.reserve(stages.size());
    for (const RunnableStage& stage : stages)
      levels_.push_back({&stage, Lanes(stage.cells), {1, 1}, {}, {}, {}, 0, 0});
    for (std::size_t i = levels_.size() - 1; i-- > 0;)
      for (std::size_t axis = 0; axis < 2; ++axis)
        levels_[i].cell_pixels[axis] = levels_[i + 1].cell_pixels[axis] * stages[i + 1].cells[axis];
    for (std::size_t i = 0; i < levels_.size(); ++i) bind(i, frame_value);
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
      if (cx < size_.width && cy < size_.height) run(i + 1, cx, cy, lane);
    }
  }

 private:
  const std::vector<float>& parent_rows(std::size_t i, const Input& table) const {
    IMP_ASSERT(i > 0, "a stage above the one that reads a table");
    const Program& above = levels_[i - 1].stage->kernel->program();
    const Output* output = above.output(table.name);
    IMP_ASSERT(output && table.type.length == levels_[i - 1].stage->cells[2],
               "the parent's output, over its slabs");
    return levels_[i - 1].rows[static_cast<std::size_t>(output - above.outputs.data())];
  }

  void bind(std::size_t i, const FrameValue& frame_value) {
    Level& level = levels_[i];
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
      level.outputs.push_back(level.rows.emplace_back(level.lanes.size()).data());
    }
  }

  void deliver(const Level& level, std::uint32_t x, std::uint32_t y) {
    columns_.clear();
    rows_.clear();
    for (std::size_t lane = 0; lane < level.lanes.size(); ++lane) {
      columns_.push_back(x + static_cast<std::uint32_t>(level.lanes.column[lane]));
      rows_.push_back(y + static_cast<std::uint32_t>(level.lanes.row[lane]));
    }
    sink_({level.lanes.size(), columns_, rows_, level.rows});
  }

  PictureSize size_;
  const PixelSink& sink_;
  std::vector<Level> levels_;
  std::array<std::uint32_t, 2> tile_{};
  std::vector<std::uint32_t> columns_, rows_;
};

}  // namespace

void run_stages(std::span<const RunnableStage> stages, PictureSize size, const FrameValue& frame_value,
                const PixelSink& sink, Workers& workers, std::stop_token stop,
                const std::function<void(double)>& progress) {
  IMP_ASSERT(!stages.empty(), "at least one stage");
  std::atomic<std::size_t> next = 0;
  workers.run([&] {
    Worker worker(stages, size, frame_value, sink);
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
