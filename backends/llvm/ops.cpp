#include "backends/llvm/ops.h"

#include <algorithm>
#include <cmath>

namespace imp {
namespace {

using llvm::CmpInst;
using llvm::ConstantFP;
using llvm::Value;
using Args = std::span<Value* const>;

// The layout of a float type, as integers of its width.
struct Layout {
  int width, fraction_bits, bias;
  int lift;   // 2^lift makes every denormal normal
  int shift;  // 2^-shift halves the way down to the denormals and below them, see scale2
  int range;  // 2^±range takes every finite number out of the range

  explicit Layout(const llvm::Type* type) {
    if (type->getScalarType()->isFloatTy())
      *this = {32, 23, 127, 32, 100, 300};
    else
      *this = {64, 52, 1023, 64, 960, 2200};
  }
  constexpr Layout(int w, int f, int b, int l, int s, int r)
      : width(w), fraction_bits(f), bias(b), lift(l), shift(s), range(r) {}
};

llvm::Constant* number(Value* like, double value) { return ConstantFP::get(like->getType(), value); }
llvm::Constant* integer(Value* like, std::int64_t value) {
  return llvm::ConstantInt::get(like->getType(), static_cast<std::uint64_t>(value), true);
}

Value* less(Packet& p, Value* a, Value* b) { return p.compare(CmpInst::FCMP_OLT, a, b); }
Value* min(Packet& p, Value* a, Value* b) { return p.select(less(p, a, b), a, b); }
Value* max(Packet& p, Value* a, Value* b) { return p.select(p.compare(CmpInst::FCMP_OGT, a, b), a, b); }
Value* floor(Packet& p, Value* a) { return p.exact(llvm::Intrinsic::floor, a); }
Value* mod(Packet& p, Value* a, Value* b) {
  return p.ir.CreateFSub(a, p.ir.CreateFMul(b, floor(p, p.ir.CreateFDiv(a, b))));
}

Value* sign(Packet& p, Value* a) {
  Value* below = p.select(less(p, a, number(a, 0)), number(a, -1), a);
  return p.select(less(p, number(a, 0), a), number(a, 1), below);
}

// The exponent field, corrected where it does not tell: denormals are lifted first, zero, infinities and
// NaN are chosen last.
Value* exponent(Packet& p, Value* a) {
  const Layout layout(a->getType());
  llvm::Type* bits_type = p.shaped(p.ir.getIntNTy(static_cast<unsigned>(layout.width)), a);
  Value* size = p.exact(llvm::Intrinsic::fabs, a);

  Value* smallest_normal = number(a, std::ldexp(1.0, 1 - layout.bias));
  Value* denormal = less(p, size, smallest_normal);
  Value* lifted = p.ir.CreateFMul(size, number(a, std::ldexp(1.0, layout.lift)));
  Value* bits = p.ir.CreateBitCast(p.select(denormal, lifted, size), bits_type);
  Value* field = p.ir.CreateLShr(bits, static_cast<std::uint64_t>(layout.fraction_bits));
  field = p.ir.CreateTrunc(field, p.shaped(p.ir.getInt32Ty(), a));
  Value* biased = p.cast(llvm::Instruction::SIToFP, field, a->getType()->getScalarType());
  Value* bias = p.select(denormal, number(a, layout.bias + layout.lift), number(a, layout.bias));
  Value* result = p.ir.CreateFSub(biased, bias);

  Value* infinity = ConstantFP::getInfinity(a->getType());
  result = p.select(p.compare(CmpInst::FCMP_OEQ, size, number(a, 0)), p.ir.CreateFNeg(infinity), result);
  return p.select(less(p, size, infinity), result, size);
}

// 2^n for n in the range of normal exponents.
Value* power_of_two(Packet& p, Value* n, Value* like) {
  const Layout layout(like->getType());
  Value* wide = p.ir.CreateSExt(n, p.shaped(p.ir.getIntNTy(static_cast<unsigned>(layout.width)), like));
  Value* biased = p.ir.CreateAdd(wide, integer(wide, layout.bias));
  Value* bits = p.ir.CreateShl(biased, static_cast<std::uint64_t>(layout.fraction_bits));
  return p.ir.CreateBitCast(bits, like->getType());
}

// Three products with powers of two, of which at most one rounds. On the way up none does before it
// overflows. On the way down a product with 2^-shift is denormal only if the result is below half of the
// smallest number, where rounding twice is rounding once.
Value* scale2(Packet& p, Value* a, Value* k) {
  const Layout layout(a->getType());
  Value* high = number(a, layout.range);
  Value* low = number(a, -layout.range);
  Value* clamped = floor(p, min(p, max(p, k, low), high));
  Value* n = p.cast(llvm::Instruction::FPToSI, clamped, p.ir.getInt32Ty());

  Value* result = a;
  for (int step = 0; step < 3; ++step) {
    Value* now = n;
    if (step < 2) {
      Value* up = integer(n, layout.bias);
      now = p.ir.CreateSelect(p.ir.CreateICmpSLT(n, integer(n, 1 - layout.bias)), integer(n, -layout.shift),
                              p.ir.CreateSelect(p.ir.CreateICmpSLT(n, up), n, up));
      n = p.ir.CreateSub(n, now);
    }
    result = p.ir.CreateFMul(result, power_of_two(p, now, a));
  }
  return p.select(p.compare(CmpInst::FCMP_UNO, k, k), k, result);
}

Value* any(Packet& p, Value* truth) {
  if (!Packet::is_wide(truth)) return truth;
  return p.widen(p.any(p.both(truth, p.active)));
}

Value* all(Packet& p, Value* truth) {
  if (!Packet::is_wide(truth)) return truth;
  return p.widen(p.ir.CreateNot(p.any(p.both(p.opposite(truth), p.active))));
}

struct Row {
  std::string_view name;
  OpBuilder build;
};

constexpr Row rows[] = {
    {"fadd", [](Packet& p, Args a) { return p.ir.CreateFAdd(a[0], a[1]); }},
    {"fsub", [](Packet& p, Args a) { return p.ir.CreateFSub(a[0], a[1]); }},
    {"fmul", [](Packet& p, Args a) { return p.ir.CreateFMul(a[0], a[1]); }},
    {"fdiv", [](Packet& p, Args a) { return p.ir.CreateFDiv(a[0], a[1]); }},
    {"fma", [](Packet& p, Args a) { return p.fma(a[0], a[1], a[2]); }},
    {"fneg", [](Packet& p, Args a) { return p.ir.CreateFNeg(a[0]); }},
    {"fabs", [](Packet& p, Args a) { return p.exact(llvm::Intrinsic::fabs, a[0]); }},
    {"min", [](Packet& p, Args a) { return min(p, a[0], a[1]); }},
    {"max", [](Packet& p, Args a) { return max(p, a[0], a[1]); }},
    {"sqrt", [](Packet& p, Args a) { return p.sqrt(a[0]); }},
    {"floor", [](Packet& p, Args a) { return floor(p, a[0]); }},
    {"ceil", [](Packet& p, Args a) { return p.exact(llvm::Intrinsic::ceil, a[0]); }},
    {"sign", [](Packet& p, Args a) { return sign(p, a[0]); }},
    {"mod", [](Packet& p, Args a) { return mod(p, a[0], a[1]); }},
    {"exponent", [](Packet& p, Args a) { return exponent(p, a[0]); }},
    {"scale2", [](Packet& p, Args a) { return scale2(p, a[0], a[1]); }},
    {"lt", [](Packet& p, Args a) { return less(p, a[0], a[1]); }},
    {"le", [](Packet& p, Args a) { return p.compare(CmpInst::FCMP_OLE, a[0], a[1]); }},
    {"eq", [](Packet& p, Args a) { return p.compare(CmpInst::FCMP_OEQ, a[0], a[1]); }},
    {"and", [](Packet& p, Args a) { return p.both(a[0], a[1]); }},
    {"or", [](Packet& p, Args a) { return p.either(a[0], a[1]); }},
    {"not", [](Packet& p, Args a) { return p.opposite(a[0]); }},
    {"select", [](Packet& p, Args a) { return p.select(a[0], a[1], a[2]); }},
    {"fpext", [](Packet& p, Args a) { return p.cast(llvm::Instruction::FPExt, a[0], p.ir.getDoubleTy()); }},
    {"fptrunc", [](Packet& p, Args a) { return p.narrow(a[0]); }},
    {"any", [](Packet& p, Args a) { return any(p, a[0]); }},
    {"all", [](Packet& p, Args a) { return all(p, a[0]); }},
};

}  // namespace

OpBuilder op_builder(std::string_view name) {
  const auto* row = std::ranges::find(rows, name, &Row::name);
  return row != std::end(rows) ? row->build : nullptr;
}

}  // namespace imp
