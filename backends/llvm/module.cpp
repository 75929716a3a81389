#include "backends/llvm/module.h"

#include <llvm/IR/IntrinsicsX86.h>
#include <llvm/IR/Verifier.h>
#include <llvm/MC/MCSubtargetInfo.h>

#include "backends/llvm/body.h"
#include "backends/llvm/ops.h"
#include "ir/assert.h"
#include "ir/regions.h"

namespace imp {
namespace {

using llvm::BasicBlock;
using llvm::Function;
using llvm::Value;

// All exceptions masked, denormals kept.
constexpr std::uint32_t mxcsr_to_nearest = 0x1f80;
constexpr std::uint32_t mxcsr_upward = 0x5f80;

// Scratch memory is on the stack: this many values for each ray. Tables that are only read may be longer.
constexpr std::uint32_t longest_table = 4096;

// The time of code generation grows faster than its input: more would take minutes.
constexpr std::size_t most_operations = 20000;

// A column of a batch that has one value a ray. The last packet, if it is not full, works on a buffer.
struct Column {
  Type type;
  Value* base;
  Value* buffer;
  Value* place = nullptr;  // of this packet
};

// Of bytes 0 and 1; numbers stay.
Value* truth_of_byte(llvm::IRBuilder<>& ir, Value* loaded) {
  if (!loaded->getType()->isIntOrIntVectorTy()) return loaded;
  return ir.CreateICmpNE(loaded, llvm::Constant::getNullValue(loaded->getType()));
}

class Builder {
 public:
  Builder(llvm::Module& module, const CpuTarget& target, const Spelling& spelling)
      : module_(module), target_(target), spelling_(spelling) {}

  void kernel(const Program& program);

 private:
  Function* function(llvm::FunctionType* type, const llvm::Twine& name, bool internal);
  Function* packets(const Program& program);
  Function* callee(const Program& program, const std::vector<Form>& forms);
  Body body(Packet& packet, const Program& program) {
    return {packet, program,
            [this](const Program& called, const std::vector<Form>& f) { return callee(called, f); }};
  }

  // Of a value that is the same for all rays.
  llvm::Type* type_of_one(Type type) {
    auto& context = module_.getContext();
    switch (type.scalar) {
      case Scalar::truth: return llvm::Type::getInt1Ty(context);
      case Scalar::f32:   return llvm::Type::getFloatTy(context);
      case Scalar::f64:   return llvm::Type::getDoubleTy(context);
    }
    return nullptr;
  }
  // As a number or a truth lies in a Batch.
  llvm::Type* memory_type(Type type) {
    return type.is_truth() ? llvm::Type::getInt8Ty(module_.getContext()) : type_of_one(type);
  }
  llvm::Type* pointer() { return llvm::PointerType::getUnqual(module_.getContext()); }

  llvm::Module& module_;
  const CpuTarget& target_;
  const Spelling spelling_;
  std::map<std::pair<const Program*, std::vector<Form>>, Function*> callees_;
};

Function* Builder::function(llvm::FunctionType* type, const llvm::Twine& name, bool internal) {
  auto* function =
      Function::Create(type, internal ? Function::InternalLinkage : Function::ExternalLinkage, name, module_);
  function->addFnAttr(llvm::Attribute::NoUnwind);
  if (spelling_.upward) function->addFnAttr(llvm::Attribute::StrictFP);
  function->addFnAttr("target-cpu", target_.cpu);
  if (!target_.features.empty()) function->addFnAttr("target-features", target_.features);
  if (target_.register_bits == 512) {
    function->addFnAttr("prefer-vector-width", "512");
    function->addFnAttr("min-legal-vector-width", "512");
  }
  BasicBlock::Create(module_.getContext(), "entry", function);
  return function;
}

// Sets the rounding mode around the packets. They are a function of their own that is never inlined, so
// nothing moves across.
void Builder::kernel(const Program& program) {
  Function* inner = packets(program);
  inner->addFnAttr(llvm::Attribute::NoInline);
  Function* outer = function(inner->getFunctionType(), kernel_symbol(program), false);
  llvm::IRBuilder<> ir(&outer->getEntryBlock());
  ir.setIsFPConstrained(spelling_.upward);
  Value* theirs = ir.CreateAlloca(ir.getInt32Ty(), nullptr, "mxcsr.theirs");
  Value* ours = ir.CreateAlloca(ir.getInt32Ty(), nullptr, "mxcsr.ours");
  ir.CreateIntrinsic(llvm::Intrinsic::x86_sse_stmxcsr, {}, {theirs});
  ir.CreateStore(ir.getInt32(spelling_.upward ? mxcsr_upward : mxcsr_to_nearest), ours);
  ir.CreateIntrinsic(llvm::Intrinsic::x86_sse_ldmxcsr, {}, {ours});
  ir.CreateCall(inner, {outer->getArg(0), outer->getArg(1), outer->getArg(2)});
  ir.CreateIntrinsic(llvm::Intrinsic::x86_sse_ldmxcsr, {}, {theirs});
  ir.CreateRetVoid();
}

// for (lane = 0; lane < count; ++lane) body(lane), with count > 0.
void for_lanes(llvm::IRBuilder<>& ir, const char* name, Value* count,
               const std::function<void(Value*)>& body) {
  auto* before = ir.GetInsertBlock();
  auto* loop = BasicBlock::Create(ir.getContext(), name, before->getParent());
  auto* end = BasicBlock::Create(ir.getContext(), llvm::Twine(name) + ".end");
  ir.CreateBr(loop);
  ir.SetInsertPoint(loop);
  auto* lane = ir.CreatePHI(ir.getInt64Ty(), 2, "lane");
  body(lane);
  Value* next = ir.CreateAdd(lane, ir.getInt64(1));
  lane->addIncoming(ir.getInt64(0), before);
  lane->addIncoming(next, loop);
  ir.CreateCondBr(ir.CreateICmpULT(next, count), loop, end);
  end->insertInto(before->getParent());
  ir.SetInsertPoint(end);
}

// entry:    what is the same for all rays
// packet:   for each `lanes` rays
//   pad:      the last ones, if they do not fill it, are copied to buffers; unused lanes repeat the last ray
//   run:      loads, the Program, stores
//   unpad:    the buffers are copied back
Function* Builder::packets(const Program& program) {
  auto& context = module_.getContext();
  auto* type = llvm::FunctionType::get(llvm::Type::getVoidTy(context),
                                       {pointer(), pointer(), llvm::Type::getInt64Ty(context)}, false);
  Function* f = function(type, kernel_symbol(program) + ".packets", true);
  f->getArg(0)->setName("inputs");
  f->getArg(1)->setName("outputs");
  f->getArg(2)->setName("size");
  Value* size = f->getArg(2);

  Packet packet(&f->getEntryBlock(), spelling_);
  auto& ir = packet.ir;
  Body nodes = body(packet, program);
  const unsigned lanes = spelling_.lanes;

  const auto load_pointer = [&](Value* array, std::size_t i, const std::string& name) {
    return ir.CreateLoad(pointer(), ir.CreateConstInBoundsGEP1_64(pointer(), array, i), name);
  };
  const auto column = [&](Type element, Value* base) {
    auto* buffer = ir.CreateAlloca(llvm::ArrayType::get(memory_type(element), lanes));
    buffer->setAlignment(llvm::Align(spelling_.register_bits / 8));
    return Column{element, base, buffer};
  };
  std::vector<std::pair<Id, Column>> inputs;
  std::vector<Column> outputs;
  for (std::size_t i = 0; i < program.inputs.size(); ++i) {
    const Input& input = program.inputs[i];
    if (!nodes.needs(input)) continue;
    Value* base = load_pointer(f->getArg(0), i, input.name);
    if (input.type.is_table())
      nodes.set(input.id, Tables::in_memory(input.type, base, true));
    else if (input.rate == Rate::ray)
      inputs.emplace_back(input.id, column(input.type, base));
    else
      nodes.set(input.id, truth_of_byte(ir, ir.CreateLoad(memory_type(input.type), base)));
  }
  for (std::size_t i = 0; i < program.outputs.size(); ++i) {
    const Output& output = program.outputs[i];
    outputs.push_back(column(program.graph[output.id].type, load_pointer(f->getArg(1), i, output.name)));
  }
  nodes.emit_before_rays();

  auto* entry = ir.GetInsertBlock();
  auto* next_packet = BasicBlock::Create(context, "packet", f);
  auto* pad = BasicBlock::Create(context, "pad", f);
  auto* run = BasicBlock::Create(context, "run");
  auto* unpad = BasicBlock::Create(context, "unpad");
  auto* stored = BasicBlock::Create(context, "stored");
  auto* exit = BasicBlock::Create(context, "exit");
  ir.CreateCondBr(ir.CreateICmpEQ(size, ir.getInt64(0)), exit, next_packet);

  ir.SetInsertPoint(next_packet);
  auto* first = ir.CreatePHI(ir.getInt64Ty(), 2, "first");
  first->addIncoming(ir.getInt64(0), entry);
  Value* left = ir.CreateSub(size, first, "left");
  Value* full = ir.CreateICmpUGE(left, ir.getInt64(lanes), "full");
  const auto element = [&](const Column& c) { return memory_type(c.type); };
  for (auto& [id, c] : inputs) c.place = ir.CreateGEP(element(c), c.base, first);
  for (Column& c : outputs)
    c.place = ir.CreateSelect(ir.CreateIsNull(c.base), c.buffer, ir.CreateGEP(element(c), c.base, first));
  const auto element_align = [&](const Column& c) {
    return llvm::Align(element(c)->getScalarSizeInBits() / 8);
  };
  const auto work_place = [&](const Column& c) { return ir.CreateSelect(full, c.place, c.buffer); };
  std::vector<Value*> sources, sinks;
  for (const auto& [id, c] : inputs) sources.push_back(work_place(c));
  for (const Column& c : outputs) sinks.push_back(work_place(c));
  ir.CreateCondBr(full, run, pad);

  const auto copy = [&](const Column& c, Value* from, Value* from_lane, Value* to, Value* to_lane) {
    Value* value = ir.CreateLoad(element(c), ir.CreateInBoundsGEP(element(c), from, from_lane));
    ir.CreateStore(value, ir.CreateInBoundsGEP(element(c), to, to_lane));
  };
  ir.SetInsertPoint(pad);
  for_lanes(ir, "pad.lane", ir.getInt64(lanes), [&](Value* lane) {
    Value* last = ir.CreateSub(left, ir.getInt64(1));
    Value* from = ir.CreateSelect(ir.CreateICmpULT(lane, last), lane, last);
    for (const auto& [id, c] : inputs) copy(c, c.place, from, c.buffer, lane);
  });
  ir.CreateBr(run);

  run->insertInto(f);
  ir.SetInsertPoint(run);
  Value* count = ir.CreateTrunc(ir.CreateSelect(full, ir.getInt64(lanes), left), ir.getInt32Ty());
  Value* live = ir.CreateICmpSLT(packet.lane_numbers(), ir.CreateVectorSplat(lanes, count), "live");
  packet.active = packet.usual(packet.mask_of(live, spelling_.mask_bits));
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const auto& [id, c] = inputs[i];
    Value* value = ir.CreateAlignedLoad(packet.over_lanes(element(c)), sources[i], element_align(c));
    if (c.type.is_truth()) value = packet.mask_of(truth_of_byte(ir, value), spelling_.mask_bits);
    value->setName(program.inputs[program.graph[id].payload].name);
    nodes.set(id, value);
  }
  nodes.emit_rays();
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const Column& c = outputs[i];
    Value* value = packet.widen(nodes.value(program.outputs[i].id));
    if (c.type.is_truth()) {
      value = ir.CreateZExt(packet.bits_of(packet.usual(value), spelling_.mask_bits),
                            packet.over_lanes(ir.getInt8Ty()));
    }
    ir.CreateAlignedStore(value, sinks[i], element_align(c));
  }
  ir.CreateCondBr(full, stored, unpad);

  unpad->insertInto(f);
  ir.SetInsertPoint(unpad);
  for_lanes(ir, "unpad.lane", left, [&](Value* lane) {
    for (const Column& c : outputs) copy(c, c.buffer, lane, c.place, lane);
  });
  ir.CreateBr(stored);

  stored->insertInto(f);
  ir.SetInsertPoint(stored);
  Value* done = ir.CreateAdd(first, ir.getInt64(lanes));
  first->addIncoming(done, stored);
  ir.CreateCondBr(ir.CreateICmpULT(done, size), next_packet, exit);

  exit->insertInto(f);
  ir.SetInsertPoint(exit);
  ir.CreateRetVoid();
  return f;
}

Function* Builder::callee(const Program& program, const std::vector<Form>& forms) {
  Function*& known = callees_[{&program, forms}];
  if (known != nullptr) return known;

  auto& context = module_.getContext();
  const auto wide = [&](Type type) -> llvm::Type* {
    const bool mask = type.is_truth() && !spelling_.bit_masks;
    return llvm::FixedVectorType::get(
        mask ? llvm::Type::getIntNTy(context, spelling_.mask_bits) : type_of_one(type), spelling_.lanes);
  };
  std::vector<llvm::Type*> args{wide(truth)}, results;
  for (std::size_t i = 0; i < forms.size(); ++i) {
    const Type type = program.inputs[i].type;
    args.push_back(forms[i] == Form::scalar ? type_of_one(type)
                   : forms[i] == Form::wide ? wide(type)
                                            : pointer());
  }
  for (const Output& output : program.outputs) results.push_back(wide(program.graph[output.id].type));
  auto* result = llvm::StructType::get(context, results);
  Function* f = function(llvm::FunctionType::get(result, args, false), program.name, true);
  known = f;

  Packet packet(&f->getEntryBlock(), spelling_);
  packet.active = f->getArg(0);
  packet.active->setName("active");
  Body nodes = body(packet, program);
  for (std::size_t i = 0; i < forms.size(); ++i) {
    const Input& input = program.inputs[i];
    llvm::Argument* arg = f->getArg(static_cast<unsigned>(i + 1));
    arg->setName(input.name);
    if (input.type.is_table())
      nodes.set(input.id, Tables::in_memory(input.type, arg, forms[i] == Form::shared_table));
    else
      nodes.set(input.id, arg);
  }
  nodes.emit_before_rays();
  nodes.emit_rays();
  Value* all = llvm::PoisonValue::get(result);
  for (unsigned i = 0; i < results.size(); ++i) {
    Value* output = packet.usual(packet.widen(nodes.value(program.outputs[i].id)));
    all = packet.ir.CreateInsertValue(all, output, i);
  }
  packet.ir.CreateRet(all);
  return f;
}

}  // namespace

std::string kernel_symbol(const Program& program) {
  std::string symbol = "imp_" + (program.name.empty() ? "kernel" : program.name);
  for (char& c : symbol)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return symbol;
}

std::optional<Refusal> refusal(const Program& program) {
  std::size_t operations = 0;
  for (const auto& nodes : schedule(program)) {
    operations += nodes.size();
    for (const Id id : nodes) {
      const Node node = program.graph[id];
      const OpInfo& op = info(node.op);
      const auto refuse = [&](std::string why) { return Refusal{std::move(why), program.graph.span(id)}; };
      if (node.type.length > longest_table)
        return refuse("a table of " + std::to_string(node.type.length) +
                      " values is too long for a kernel; " + std::to_string(longest_table) + " is the most");
      if (node.op == Op::powi)
        return refuse("'powi' has no kernel form: the power pass must expand it first");
      if (op.kind != OpKind::structure && op_builder(op.llvm) == nullptr)
        return refuse("'" + std::string(op.name) + "' has no kernel form yet; use --backend=interpreter");
      if (node.op != Op::call) continue;
      if (auto why = refusal(*program.callees[node.high()])) return why;
    }
  }
  if (operations <= most_operations) return std::nullopt;
  return Refusal{"this takes " + std::to_string(operations) + " operations, and a kernel has at most " +
                 std::to_string(most_operations) + "; use --backend=interpreter"};
}

std::unique_ptr<llvm::Module> build_module(const Program& program, const CpuTarget& target,
                                           llvm::TargetMachine& machine, llvm::LLVMContext& context) {
  auto module = std::make_unique<llvm::Module>(program.name, context);
  module->setTargetTriple(machine.getTargetTriple().str());
  module->setDataLayout(machine.createDataLayout());

  const auto has = [&](const char* feature) { return machine.getMCSubtargetInfo()->checkFeatures(feature); };
  Spelling spelling;
  spelling.lanes = target.lanes(program);
  spelling.register_bits = target.register_bits;
  spelling.mask_bits = target.packet_registers * target.register_bits / spelling.lanes;
  spelling.bit_masks = target.register_bits == 512;
  spelling.fuses = has("+fma");
  spelling.upward = rounds_up(program);
  Builder(*module, target, spelling).kernel(program);
#ifndef NDEBUG
  IMP_ASSERT(!llvm::verifyModule(*module, &llvm::errs()), "a module that LLVM accepts");
#endif
  return module;
}

}  // namespace imp
