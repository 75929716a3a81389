// The values of a packet, one function at a time: how numbers and truths of `lanes` rays lie in LLVM values.
//
//   number  the same for all rays: float, double       one a ray: <lanes x float>, <lanes x double>
//   truth   the same for all rays: i1                  one a ray: a mask
//
// A mask is <lanes x i32> or <lanes x i64>, all ones where true, as wide as the numbers it came from: so
// SSE and AVX2 hold it, and LLVM never packs it into bytes. AVX-512 has registers for <lanes x i1>.
#pragma once

#include <llvm/ADT/DenseMap.h>
#include <llvm/IR/IRBuilder.h>

#include <span>

namespace imp {

// What the target and the Program decide.
struct Spelling {
  unsigned lanes = 0;
  unsigned register_bits = 0;
  unsigned mask_bits = 32;  // of masks that live across blocks: the width of the packet's widest number
  bool bit_masks = false;   // AVX-512
  bool fuses = false;       // has a fused multiply-add
  bool upward = false;      // rounds upward: every arithmetic op is a constrained intrinsic
};

class Packet {
 public:
  Packet(llvm::BasicBlock* block, const Spelling& rules);

  llvm::IRBuilder<> ir;
  const Spelling rules;
  llvm::Value* active = nullptr;  // mask of the rays that speak; null where there is one value for all rays

  static bool is_wide(const llvm::Value* value) { return value->getType()->isVectorTy(); }
  llvm::Type* over_lanes(llvm::Type* element) const;
  llvm::Type* mask_type() const;
  llvm::Constant* lane_numbers() const;  // <0, 1, 2, …> of i32

  llvm::Value* widen(llvm::Value* value);               // to all lanes; a truth to a mask of the usual width
  void widen_together(std::span<llvm::Value*> values);  // if one of them is wide, all

  // Exact ops are plain instructions in every rounding mode. The others are plain to nearest, constrained
  // upward.
  llvm::Value* compare(llvm::CmpInst::Predicate predicate, llvm::Value* a, llvm::Value* b);
  llvm::Value* select(llvm::Value* truth, llvm::Value* a, llvm::Value* b);
  llvm::Value* exact(llvm::Intrinsic::ID op, llvm::Value* a);
  llvm::Value* cast(llvm::Instruction::CastOps op, llvm::Value* a, llvm::Type* element);  // exact ones
  llvm::Value* sqrt(llvm::Value* a);
  llvm::Value* fma(llvm::Value* a, llvm::Value* b, llvm::Value* c);
  llvm::Value* narrow(llvm::Value* a);

  llvm::Value* both(llvm::Value* a, llvm::Value* b);
  llvm::Value* either(llvm::Value* a, llvm::Value* b);
  llvm::Value* opposite(llvm::Value* a);

  // Of one truth for each ray to one i1, over the lanes that are set.
  llvm::Value* any(llvm::Value* mask);

  // To and from <lanes x i1>. `width`: of the numbers that the bits will choose between.
  llvm::Value* mask_of(llvm::Value* bits, unsigned width);
  llvm::Value* bits_of(llvm::Value* mask, unsigned width);
  llvm::Value* usual(llvm::Value* value);  // a mask of the usual width; anything else as it is

  // Like `element`, or a vector of it if `like` is one.
  llvm::Type* shaped(llvm::Type* element, const llvm::Value* like) const;

 private:
  llvm::Value* resize(llvm::Value* mask, unsigned width);
  llvm::Value* combine(llvm::Instruction::BinaryOps op, llvm::Value* a, llvm::Value* b);
  llvm::Function* intrinsic(llvm::Intrinsic::ID id, llvm::ArrayRef<llvm::Type*> types);

  llvm::DenseMap<llvm::Value*, llvm::Value*> known_bits_;  // of masks, where they were made
};

}  // namespace imp
