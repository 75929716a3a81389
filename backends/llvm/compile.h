// From a Program to machine code.
#pragma once

#include <expected>
#include <memory>
#include <string>

#include "backends/kernel.h"
#include "backends/llvm/target.h"

namespace imp {

enum class CodeForm : std::uint8_t { llvm_ir, assembly, object };

// Milliseconds spent, for --timings.
struct CompileTimes {
  double build = 0, codegen = 0;
};

// A kernel in this process. An error where the target does not run here, or the Program holds an
// op that no kernel can hold ("'sin' has no kernel form; …").
std::expected<std::unique_ptr<Kernel>, Refusal> compile(const Program& program, const CpuTarget& target,
                                                        CompileTimes* times = nullptr);

// The same code as text or as the bytes of an object file, for any target.
std::expected<std::string, Refusal> emit(const Program& program, const CpuTarget& target, CodeForm form);

}  // namespace imp
