// A Program as an LLVM module: the kernel, the function that runs it for packets, and those it calls.
#pragma once

#include <llvm/IR/Module.h>
#include <llvm/Target/TargetMachine.h>

#include <expected>
#include <memory>
#include <string>

#include "backends/kernel.h"
#include "backends/llvm/target.h"

namespace imp {

// The symbol of the kernel,
//   void NAME(const void* const* inputs, void* const* outputs, uint64_t size);
// with inputs and outputs as in Batch: the Program's name as C can spell it.
std::string kernel_symbol(const Program& program);

// What keeps the Program from having a kernel, or nothing.
std::optional<Refusal> refusal(const Program& program);

// Of a Program that is not refused.
std::unique_ptr<llvm::Module> build_module(const Program& program, const CpuTarget& target,
                                           llvm::TargetMachine& machine, llvm::LLVMContext& context);

}  // namespace imp
