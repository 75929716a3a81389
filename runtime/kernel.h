// From a Program to a Kernel: the passes, then a backend.
#pragma once

#include <expected>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "backends/interpreter/interpreter.h"
#include "backends/kernel.h"
#include "passes/pass.h"
#include "runtime/options.h"

namespace imp {

// Milliseconds, by stage of the way: for --timings.
struct Timings {
  struct Entry {
    std::string name;
    double milliseconds;
  };
  std::vector<Entry> entries;
};

// What `lower` runs, in order.
std::vector<Pass> passes_for(const KernelOptions& options);

// What there is: those of formulas, and those that `lower` may run.
std::vector<Pass> all_passes();

// The Program as a backend gets it.
Program lower(Program program, const KernelOptions& options, PassTrace* trace = nullptr);

// Errors say what is not to be had and what would be.
std::expected<std::unique_ptr<Kernel>, Refusal> make_kernel(Program program, const KernelOptions& options,
                                                            Timings* timings = nullptr);

// One input column: a value for every row, or a single one for all.
using Column = std::vector<double>;

// Runs a kernel whose inputs are all f64 over `rows` rows: one column an input, in order; returns
// one column an output (truths as 0 and 1).
std::vector<Column> run_rows(const Kernel& kernel, std::span<const Column> inputs, std::size_t rows);

}  // namespace imp
