#include "backends/llvm/compile.h"

#include <llvm/ExecutionEngine/Orc/LLJIT.h>
#include <llvm/Support/MemoryBuffer.h>

#include <chrono>

#include "backends/llvm/codegen.h"
#include "backends/llvm/module.h"
#include "ir/assert.h"

namespace imp {
namespace {

using Entry = void (*)(const void* const* inputs, void* const* outputs, std::uint64_t size);

// Owns its JIT, so its code goes when it goes, and kernels know nothing of each other.
class JitKernel : public Kernel {
 public:
  JitKernel(Program program, std::unique_ptr<llvm::orc::LLJIT> jit, Entry entry)
      : Kernel(std::move(program)), jit_(std::move(jit)), entry_(entry) {}

  void run(const Batch& batch) const override {
    IMP_ASSERT(batch.inputs.size() == program().inputs.size(), "one column an input");
    IMP_ASSERT(batch.outputs.size() == program().outputs.size(), "one column an output");
    entry_(batch.inputs.data(), batch.outputs.data(), batch.size);
  }

 private:
  std::unique_ptr<llvm::orc::LLJIT> jit_;
  Entry entry_;
};

class Stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double, std::milli>(now - std::exchange(start_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::expected<llvm::SmallVector<char, 0>, Refusal> code(const Program& program, const CpuTarget& target,
                                                        CodeForm form, CompileTimes& times) {
  Stopwatch watch;
  if (auto why = refusal(program)) return std::unexpected(*std::move(why));
  auto machine = target_machine(target);
  if (!machine) return std::unexpected(Refusal{machine.error()});

  llvm::LLVMContext context;
  context.setDiscardValueNames(form == CodeForm::object);
  const auto module = build_module(program, target, **machine, context);
  times.build = watch.lap();
  auto bytes = generate(*module, **machine, form);
  times.codegen = watch.lap();
  return bytes;
}

// The object needs nothing from outside, so the JIT does not look into the process.
llvm::Expected<std::unique_ptr<llvm::orc::LLJIT>> load(std::unique_ptr<llvm::MemoryBuffer> object) {
  auto jit = llvm::orc::LLJITBuilder()
                 .setPlatformSetUp(llvm::orc::setUpInactivePlatform)
                 .setLinkProcessSymbolsByDefault(false)
                 .create();
  if (!jit) return jit;
  if (auto error = (*jit)->addObjectFile(std::move(object))) return error;
  return jit;
}

}  // namespace

std::expected<std::unique_ptr<Kernel>, Refusal> compile(const Program& program, const CpuTarget& target,
                                                        CompileTimes* times) {
  if (!target.runs_here)
    return std::unexpected(Refusal{"this processor cannot run code for '" + target.name + "'"});
  CompileTimes spent;
  auto bytes = code(program, target, CodeForm::object, spent);
  if (!bytes) return std::unexpected(bytes.error());

  Stopwatch watch;
  auto jit = load(llvm::MemoryBuffer::getMemBufferCopy({bytes->data(), bytes->size()}, program.name));
  if (!jit) return std::unexpected(Refusal{llvm::toString(jit.takeError())});
  auto entry = (*jit)->lookup(kernel_symbol(program));
  if (!entry) return std::unexpected(Refusal{llvm::toString(entry.takeError())});
  spent.codegen += watch.lap();
  if (times != nullptr) *times = spent;
  return std::make_unique<JitKernel>(program, std::move(*jit), entry->toPtr<Entry>());
}

std::expected<std::string, Refusal> emit(const Program& program, const CpuTarget& target, CodeForm form) {
  CompileTimes times;
  auto bytes = code(program, target, form, times);
  if (!bytes) return std::unexpected(bytes.error());
  return std::string(bytes->data(), bytes->size());
}

}  // namespace imp
