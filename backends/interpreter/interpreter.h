// The reference backend: slow and obvious. It executes ops.def as it stands, one ray at a time
// (a packet is one ray, so any and all are identities), in the rounding mode the Program asks for.
#pragma once

#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "backends/kernel.h"

namespace imp {

// One step of a phase, for `imp trace` and for tests: the states before it.
struct TraceStep {
  std::size_t ray;
  std::size_t phase;
  std::uint32_t step;          // from 0; the last one of a phase shows the final states
  bool again;                  // whether the step is taken
  std::vector<double> states;  // in the order of Phase::states; truths as 0 or 1, tables whole
};

using Trace = std::function<void(const TraceStep&)>;  // called rounding to nearest

std::unique_ptr<Kernel> interpret(Program program, Trace trace = {});

}  // namespace imp
