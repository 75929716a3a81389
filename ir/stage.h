// Stages: Programs mapped over the cells of a grid, coarse to fine.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "ir/diagnostics.h"
#include "ir/program.h"

namespace imp {

// A Program run once for every cell of a grid. The runtime cuts the picture into tiles; each tile is
// divided into `cells` (columns, rows, slabs) for the first stage, each cell of a stage into `cells`
// for the next one; the cells of the last stage are pixels. The Program may have the inputs
//   column, row, slab  f32, rate ray: the place of the cell within its parent
//   x0, y0             f32, rate cell: the first pixel of the parent
// and reads its parent by tables of rate cell: one that is named as an output of the stage before
// holds that output over the slabs of the parent cell, in order. Where a stage has an output `needed` that is
// 0 for all slabs of a cell, the stages below do not run for it.
struct Stage {
  std::array<std::uint32_t, 3> cells{1, 1, 1};
  Program program;
};

using Pipeline = std::vector<Stage>;

}  // namespace imp
