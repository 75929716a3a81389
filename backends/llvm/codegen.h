// From a module to text and bytes.
#pragma once

#include <llvm/IR/Module.h>
#include <llvm/Target/TargetMachine.h>

#include <memory>

#include "backends/llvm/compile.h"

namespace imp {

std::expected<std::unique_ptr<llvm::TargetMachine>, std::string> target_machine(const CpuTarget& target);

// The module is used up.
llvm::SmallVector<char, 0> generate(llvm::Module& module, llvm::TargetMachine& machine, CodeForm form);

}  // namespace imp
