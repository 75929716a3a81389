#include "backends/llvm/packet.h"

#include <llvm/IR/Intrinsics.h>

#include <algorithm>

namespace imp {
namespace {

using llvm::Value;

// Plain instructions for as long as it lives.
class Plain {
 public:
  explicit Plain(llvm::IRBuilder<>& ir) : ir_(ir), before_(ir.getIsFPConstrained()) {
    ir.setIsFPConstrained(false);
  }
  ~Plain() { ir_.setIsFPConstrained(before_); }
  Plain(const Plain&) = delete;
  Plain& operator=(const Plain&) = delete;

 private:
  llvm::IRBuilder<>& ir_;
  bool before_;
};

bool is_truth(const Value* value) { return value->getType()->isIntOrIntVectorTy(); }

}  // namespace

Packet::Packet(llvm::BasicBlock* block, const Spelling& spelling) : ir(block), rules(spelling) {
  ir.setIsFPConstrained(rules.upward);
  ir.setDefaultConstrainedRounding(llvm::RoundingMode::TowardPositive);
  ir.setDefaultConstrainedExcept(llvm::fp::ebIgnore);
}

llvm::Type* Packet::over_lanes(llvm::Type* element) const {
  return llvm::FixedVectorType::get(element, rules.lanes);
}

llvm::Type* Packet::mask_type() const {
  auto& context = ir.getContext();
  return over_lanes(llvm::Type::getIntNTy(context, rules.bit_masks ? 1 : rules.mask_bits));
}

llvm::Constant* Packet::lane_numbers() const {
  llvm::SmallVector<std::uint32_t, 64> numbers(rules.lanes);
  for (std::uint32_t i = 0; i < rules.lanes; ++i) numbers[i] = i;
  return llvm::ConstantDataVector::get(ir.getContext(), numbers);
}

llvm::Type* Packet::shaped(llvm::Type* element, const Value* like) const {
  return is_wide(like) ? over_lanes(element) : element;
}

Value* Packet::widen(Value* value) {
  if (is_wide(value)) return value;
  if (is_truth(value) && !rules.bit_masks) value = ir.CreateSExt(value, ir.getIntNTy(rules.mask_bits));
  return ir.CreateVectorSplat(rules.lanes, value);
}

void Packet::widen_together(std::span<Value*> values) {
  if (std::ranges::none_of(values, is_wide)) return;
  for (Value*& value : values) value = widen(value);
}

Value* Packet::compare(llvm::CmpInst::Predicate predicate, Value* a, Value* b) {
  const Plain plain(ir);
  Value* bits = ir.CreateFCmp(predicate, a, b);
  return is_wide(bits) ? mask_of(bits, a->getType()->getScalarSizeInBits()) : bits;
}

Value* Packet::select(Value* truth, Value* a, Value* b) {
  if (is_truth(a) && is_wide(a)) a = usual(a), b = usual(b);
  if (is_wide(truth)) truth = bits_of(truth, a->getType()->getScalarSizeInBits());
  return ir.CreateSelect(truth, a, b);
}

Value* Packet::exact(llvm::Intrinsic::ID op, Value* a) {
  const Plain plain(ir);
  return ir.CreateUnaryIntrinsic(op, a);
}

Value* Packet::cast(llvm::Instruction::CastOps op, Value* a, llvm::Type* element) {
  const Plain plain(ir);
  return ir.CreateCast(op, a, shaped(element, a));
}

llvm::Function* Packet::intrinsic(llvm::Intrinsic::ID id, llvm::ArrayRef<llvm::Type*> types) {
  return llvm::Intrinsic::getDeclaration(ir.GetInsertBlock()->getModule(), id, types);
}

Value* Packet::sqrt(Value* a) {
  if (!rules.upward) return ir.CreateUnaryIntrinsic(llvm::Intrinsic::sqrt, a);
  return ir.CreateConstrainedFPCall(intrinsic(llvm::Intrinsic::experimental_constrained_sqrt, a->getType()),
                                    a);
}

Value* Packet::fma(Value* a, Value* b, Value* c) {
  if (!rules.fuses) return ir.CreateFAdd(ir.CreateFMul(a, b), c);
  if (!rules.upward) return ir.CreateIntrinsic(llvm::Intrinsic::fma, a->getType(), {a, b, c});
  return ir.CreateConstrainedFPCall(intrinsic(llvm::Intrinsic::experimental_constrained_fma, a->getType()),
                                    {a, b, c});
}

Value* Packet::narrow(Value* a) { return ir.CreateFPTrunc(a, shaped(ir.getFloatTy(), a)); }

Value* Packet::combine(llvm::Instruction::BinaryOps op, Value* a, Value* b) {
  if (a->getType() != b->getType()) a = usual(a), b = usual(b);
  return ir.CreateBinOp(op, a, b);
}

Value* Packet::both(Value* a, Value* b) { return combine(llvm::Instruction::And, a, b); }
Value* Packet::either(Value* a, Value* b) { return combine(llvm::Instruction::Or, a, b); }
Value* Packet::opposite(Value* a) { return ir.CreateNot(a); }

// Halves are joined until one register is left: LLVM's own way packs all of them into bytes.
Value* Packet::any(Value* mask) {
  if (!is_wide(mask)) return mask;
  unsigned lanes = rules.lanes;
  while (!rules.bit_masks && lanes * mask->getType()->getScalarSizeInBits() > rules.register_bits) {
    llvm::SmallVector<int, 64> numbers(lanes);
    for (unsigned i = 0; i < lanes; ++i) numbers[i] = static_cast<int>(i);
    const auto order = llvm::ArrayRef(numbers);
    lanes /= 2;
    mask = ir.CreateOr(ir.CreateShuffleVector(mask, order.take_front(lanes)),
                       ir.CreateShuffleVector(mask, order.drop_front(lanes)));
  }
  Value* bits =
      rules.bit_masks ? mask : ir.CreateICmpSLT(mask, llvm::Constant::getNullValue(mask->getType()));
  Value* word = ir.CreateBitCast(bits, ir.getIntNTy(lanes));
  return ir.CreateICmpNE(word, llvm::Constant::getNullValue(word->getType()));
}

Value* Packet::mask_of(Value* bits, unsigned width) {
  if (rules.bit_masks) return bits;
  Value* mask = ir.CreateSExt(bits, over_lanes(ir.getIntNTy(width)));
  known_bits_[mask] = bits;
  return mask;
}

Value* Packet::bits_of(Value* mask, unsigned width) {
  if (rules.bit_masks) return mask;
  // Not across blocks, where the bits would have to be kept in a register of their own.
  if (Value* bits = known_bits_.lookup(mask)) {
    const auto* where = llvm::dyn_cast<llvm::Instruction>(bits);
    if (where != nullptr && where->getParent() == ir.GetInsertBlock()) return bits;
  }
  mask = resize(mask, width);
  return ir.CreateICmpSLT(mask, llvm::Constant::getNullValue(mask->getType()));
}

Value* Packet::usual(Value* value) {
  return is_wide(value) && is_truth(value) && !rules.bit_masks ? resize(value, rules.mask_bits) : value;
}

Value* Packet::resize(Value* mask, unsigned width) {
  return ir.CreateSExtOrTrunc(mask, over_lanes(ir.getIntNTy(width)));
}

}  // namespace imp
