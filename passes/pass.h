// A pass is a name and a function from Program to Program.
#pragma once

#include <chrono>
#include <iosfwd>
#include <span>
#include <string_view>
#include <vector>

#include "ir/program.h"

namespace imp {

// What a pass keeps for every output.
enum class Preserves : std::uint8_t {
  bits,       // the same bits in the same rounding mode
  value,      // the same real number; roundings may differ
  enclosure,  // a value becomes an enclosure of it
};

struct Pass {
  std::string_view name;
  Preserves preserves;
  Program (*run)(const Program&);
};

struct PassTime {
  std::string_view name;
  std::chrono::nanoseconds time;
  std::size_t nodes_before, nodes_after;
  bool changed;
};

// What to tell while passes run.
struct PassTrace {
  std::vector<PassTime> times;
  std::ostream* text = nullptr;  // where set: the Program after each pass that changed it
  std::string_view print_after;  // where set: only after this pass, changed or not
};

// Runs `passes` in order, first on what the Program calls: a pass that changes inputs or outputs is
// for Programs without calls. Verifies after each one in debug builds.
Program run_passes(Program program, std::span<const Pass> passes, PassTrace* trace = nullptr);

// What every kernel goes through before a backend sees it.
std::span<const Pass> kernel_passes();

}  // namespace imp
