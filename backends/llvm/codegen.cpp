#include "backends/llvm/codegen.h"

#include <llvm/IR/LegacyPassManager.h>
#include <llvm/MC/TargetRegistry.h>
#include <llvm/Support/ErrorHandling.h>
#include <llvm/Support/TargetSelect.h>
#include <llvm/Support/raw_ostream.h>
#include <llvm/TargetParser/Host.h>

#include <new>

#include "ir/assert.h"

namespace imp {
namespace {

// LLVM aborts where memory ends, and where the loader gets none for code; who has said how `new` ends is asked.
void end_as_new_does(void* /*unused*/, const char* /*reason*/, bool /*crash*/) {
  if (const auto handler = std::get_new_handler()) handler();
}

}  // namespace

std::expected<std::unique_ptr<llvm::TargetMachine>, std::string> target_machine(const CpuTarget& target) {
  static const bool initialized = [] {
    LLVMInitializeX86TargetInfo();
    LLVMInitializeX86Target();
    LLVMInitializeX86TargetMC();
    LLVMInitializeX86AsmPrinter();
    llvm::install_bad_alloc_error_handler(end_as_new_does);
    llvm::install_fatal_error_handler(end_as_new_does);
    return true;
  }();
  static_cast<void>(initialized);

  const std::string triple = llvm::sys::getDefaultTargetTriple();
  std::string error;
  const llvm::Target* found = llvm::TargetRegistry::lookupTarget(triple, error);
  if (found == nullptr) return std::unexpected(error);
  llvm::TargetOptions options;
  options.AllowFPOpFusion = llvm::FPOpFusion::Strict;
  std::unique_ptr<llvm::TargetMachine> machine(
      found->createTargetMachine(triple, target.cpu, target.features, options, llvm::Reloc::PIC_,
                                 llvm::CodeModel::Small, llvm::CodeGenOptLevel::Default));
  if (machine == nullptr) return std::unexpected("LLVM has no code for '" + target.cpu + "'");
  return machine;
}

// There are no passes on LLVM IR: the graph is free of what they would find, early-cse gains nothing, and
// instcombine turns masks back into <lanes x i1>, which made kernels up to 1.8 times slower.
llvm::SmallVector<char, 0> generate(llvm::Module& module, llvm::TargetMachine& machine, CodeForm form) {
  llvm::SmallVector<char, 0> bytes;
  llvm::raw_svector_ostream out(bytes);
  if (form == CodeForm::llvm_ir) {
    module.print(out, nullptr);
    return bytes;
  }
  llvm::legacy::PassManager passes;
  const auto type =
      form == CodeForm::object ? llvm::CodeGenFileType::ObjectFile : llvm::CodeGenFileType::AssemblyFile;
  const bool cannot = machine.addPassesToEmitFile(passes, out, nullptr, type);
  IMP_ASSERT(!cannot, "a target that writes files");
  passes.run(module);
  return bytes;
}

}  // namespace imp
