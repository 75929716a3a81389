// A Program made runnable: what every backend returns.
#pragma once

#include <cstddef>
#include <span>

#include "ir/program.h"

namespace imp {

// The data of one call. Numbers lie as float or double, truths as bytes 0 or 1, by the types that
// the Program declares.
struct Batch {
  std::size_t size = 0;                 // rays
  std::span<const void* const> inputs;  // one an input. Rate frame or cell: one value (a table: all
                                        // of its values); rate ray: `size` values
  std::span<void* const> outputs;       // one an output: `size` values; null: not wanted
};

// Why no kernel can be made of a Program, with the place in the text where it has one.
struct Refusal {
  std::string message;
  Span span{};
};

class Kernel {
 public:
  virtual ~Kernel() = default;

  // Runs the Program for every ray of the batch. Safe from many threads at once; the caller's
  // rounding mode is left as it was.
  virtual void run(const Batch& batch) const = 0;

  const Program& program() const { return program_; }

 protected:
  explicit Kernel(Program program) : program_(std::move(program)) {}

 private:
  Program program_;
};

}  // namespace imp
