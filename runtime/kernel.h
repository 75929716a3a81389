// From a Program to a Kernel: the passes, then a backend.
#pragma once

#include <algorithm>
#include <chrono>
#include <expected>
#include <memory>
#include <optional>
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

// What `work` returns; the time it took is entered under this name, with what it took before.
template <class Work>
auto timed(Timings* timings, const std::string& name, const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  auto result = work();
  const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start;
  if (timings == nullptr) return result;
  const auto entry = std::ranges::find(timings->entries, name, &Timings::Entry::name);
  if (entry != timings->entries.end())
    entry->milliseconds += spent.count();
  else
    timings->entries.push_back({name, spent.count()});
  return result;
}

// What `lower` runs, in order.
std::vector<Pass> passes_for(const KernelOptions& options);

// What there is: those of formulas, and those that `lower` may run.
std::vector<Pass> all_passes();

// The Program as a backend gets it.
Program lower(Program program, const KernelOptions& options, PassTrace* trace = nullptr);

// Why `program`, which `lower` has not seen, will be refused in any case: passes would take seconds over it only
// to say so, and the memory of a machine.
std::optional<Refusal> far_too_long(const Program& program, const KernelOptions& options);

// The same of an f that is to be searched: values and derivatives of it, enclosed, will be part of the Program.
std::optional<Refusal> far_too_long_to_search(const Program& f, const KernelOptions& options);

// Errors say what is not to be had and what would be.
std::expected<std::unique_ptr<Kernel>, Refusal> make_kernel(Program program, const KernelOptions& options,
                                                            Timings* timings = nullptr);

// Of what `lower` returned.
std::expected<std::unique_ptr<Kernel>, Refusal> make_lowered_kernel(Program program,
                                                                    const KernelOptions& options,
                                                                    Timings* timings = nullptr);

// One input column: a value for every row, or a single one for all.
using Column = std::vector<double>;

// Runs a kernel whose inputs are all f64 over `rows` rows: one column an input, in order; returns
// one column an output (truths as 0 and 1).
std::vector<Column> run_rows(const Kernel& kernel, std::span<const Column> inputs, std::size_t rows);

}  // namespace imp
