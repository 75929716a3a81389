#include "backends/llvm/tables.h"

#include <llvm/IR/Intrinsics.h>

#include "ir/assert.h"

namespace imp {

using llvm::Value;

Index Tables::index(Type table, Value* number) {
  auto& p = packet_;
  Value* zero = llvm::ConstantFP::get(number->getType(), 0);
  Value* last = llvm::ConstantFP::get(number->getType(), table.length - 1);
  number = p.select(p.compare(llvm::CmpInst::FCMP_OGT, number, zero), number, zero);
  number = p.select(p.compare(llvm::CmpInst::FCMP_OLT, number, last), number, last);
  return {{}, p.cast(llvm::Instruction::FPToSI, number, p.ir.getInt32Ty())};
}

Table Tables::in_registers(Type type, std::vector<Value*> elements) {
  return {.type = type, .elements = std::move(elements), .memory = nullptr, .shared = false, .stores = {}};
}

Table Tables::in_memory(Type type, Value* memory, bool shared) {
  return {.type = type, .elements = {}, .memory = memory, .shared = shared, .stores = {}};
}

Table Tables::fill(Type type, Value* value, bool registers) {
  if (registers) return in_registers(type, std::vector<Value*>(type.length, value));
  Table table = in_memory(type, nullptr, false);
  table.stores.push_back({{}, value});
  return table;
}

Table Tables::store(Table table, const Index& index, Value* value, bool registers) {
  if (!registers) {
    table.stores.push_back({index, value});
    return table;
  }
  if (!table.in_registers()) table = to_registers(table);
  if (index.constant) {
    table.elements[*index.constant] = value;
    return table;
  }
  for (std::uint32_t i = 0; i < table.type.length; ++i)
    table.elements[i] = choose(is_at(index, {i, nullptr}), value, table.elements[i]);
  return table;
}

Value* Tables::load(const Table& table, const Index& index) {
  if (table.in_registers()) return one_of(table.elements, index);

  std::size_t next = 0;
  Value* value = nullptr;
  if (table.memory != nullptr)
    value = element_in_memory(table, index);
  else
    value = table.stores[next++].value;
  for (; next < table.stores.size(); ++next) {
    const auto& store = table.stores[next];
    if (store.index.constant && index.constant) {
      if (*store.index.constant == *index.constant) value = store.value;
    } else {
      value = choose(is_at(store.index, index), store.value, value);
    }
  }
  return value;
}

Table Tables::keep(const Table& table) {
  auto& p = packet_;
  llvm::BasicBlock& entry = p.ir.GetInsertBlock()->getParent()->getEntryBlock();
  llvm::IRBuilder<> at_entry(&entry, entry.begin());
  auto* type = llvm::ArrayType::get(p.over_lanes(element_type(table.type)), table.type.length);
  const Table kept = in_memory(table.type, at_entry.CreateAlloca(type), false);
  for_each(table.type, [&](const Index& i) { put(kept, i, load(table, i), nullptr); });
  return kept;
}

Table Tables::to_registers(const Table& table) {
  std::vector<Value*> elements(table.type.length);
  for (std::uint32_t i = 0; i < table.type.length; ++i)
    elements[i] = packet_.widen(load(table, {i, nullptr}));
  return in_registers(table.type, std::move(elements));
}

void Tables::update(const Table& state, const Table& next, Value* mask) {
  if (next.memory != state.memory) {
    for_each(state.type, [&](const Index& i) { put(state, i, load(next, i), mask); });
    return;
  }
  for (const auto& store : next.stores) put(state, store.index, store.value, mask);
}

llvm::Type* Tables::element_type(Type type) const {
  return type.scalar == Scalar::f32 ? packet_.ir.getFloatTy() : packet_.ir.getDoubleTy();
}

// Short tables element by element, long ones in a loop.
void Tables::for_each(Type type, const std::function<void(const Index&)>& body) {
  if (type.length <= 2 * short_length) {
    for (std::uint32_t i = 0; i < type.length; ++i) body({i, nullptr});
    return;
  }
  auto& ir = packet_.ir;
  auto* function = ir.GetInsertBlock()->getParent();
  auto* before = ir.GetInsertBlock();
  auto* loop = llvm::BasicBlock::Create(ir.getContext(), "elements", function);
  auto* after = llvm::BasicBlock::Create(ir.getContext(), "elements.end", function);
  ir.CreateBr(loop);
  ir.SetInsertPoint(loop);
  auto* i = ir.CreatePHI(ir.getInt32Ty(), 2, "element");
  body({{}, i});
  Value* next = ir.CreateAdd(i, ir.getInt32(1));
  i->addIncoming(ir.getInt32(0), before);
  i->addIncoming(next, ir.GetInsertBlock());
  ir.CreateCondBr(ir.CreateICmpULT(next, ir.getInt32(type.length)), loop, after);
  ir.SetInsertPoint(after);
}

// The bits of the rays for which both are the same place; null for all of them.
Value* Tables::is_at(const Index& index, const Index& place) {
  auto& ir = packet_.ir;
  const auto number = [&](const Index& i) -> Value* {
    return i.constant ? ir.getInt32(*i.constant) : i.value;
  };
  Value* a = number(index);
  Value* b = number(place);
  if (a == nullptr) return nullptr;
  if (Packet::is_wide(a) && !Packet::is_wide(b)) b = ir.CreateVectorSplat(packet_.rules.lanes, b);
  if (Packet::is_wide(b) && !Packet::is_wide(a)) a = ir.CreateVectorSplat(packet_.rules.lanes, a);
  return ir.CreateICmpEQ(a, b);
}

Value* Tables::choose(Value* bits, Value* a, Value* b) {
  if (bits == nullptr) return a;
  if (Packet::is_wide(bits) || Packet::is_wide(a) || Packet::is_wide(b)) {
    a = packet_.widen(a);
    b = packet_.widen(b);
  }
  return packet_.ir.CreateSelect(bits, a, b);
}

Value* Tables::one_of(const std::vector<Value*>& elements, const Index& index) {
  if (index.constant) return elements[*index.constant];
  Value* value = elements[0];
  for (std::uint32_t i = 1; i < elements.size(); ++i)
    value = choose(is_at(index, {i, nullptr}), elements[i], value);
  return value;
}

Value* Tables::place(const Table& table, const Index& index) {
  auto& ir = packet_.ir;
  llvm::Type* element = element_type(table.type);
  if (!table.shared) element = packet_.over_lanes(element);
  Value* number = index.constant ? ir.getInt64(*index.constant) : ir.CreateZExt(index.value, ir.getInt64Ty());
  return ir.CreateInBoundsGEP(element, table.memory, number);
}

// Of an element in scratch memory, for each lane.
Value* Tables::offsets(Value* index) {
  auto& ir = packet_.ir;
  Value* row = ir.CreateMul(index, llvm::ConstantInt::get(index->getType(), packet_.rules.lanes));
  return ir.CreateAdd(row, packet_.lane_numbers());
}

Value* Tables::element_in_memory(const Table& table, const Index& index) {
  auto& ir = packet_.ir;
  llvm::Type* element = element_type(table.type);
  const bool wide = index.value != nullptr && Packet::is_wide(index.value);
  if (!table.shared) {
    return wide ? gather(element, table.memory, offsets(index.value))
                : ir.CreateLoad(packet_.over_lanes(element), place(table, index));
  }
  const auto shared_element = [&](const Index& i) {
    auto* load = ir.CreateLoad(element, place(table, i));
    load->setMetadata(llvm::LLVMContext::MD_invariant_load, llvm::MDNode::get(ir.getContext(), {}));
    return load;
  };
  if (!wide) return shared_element(index);
  if (table.type.length > short_length) return gather(element, table.memory, index.value);
  std::vector<Value*> elements(table.type.length);
  for (std::uint32_t i = 0; i < table.type.length; ++i) elements[i] = shared_element({i, nullptr});
  return one_of(elements, index);
}

// Lane by lane where there is no instruction for it, and on AVX2, where it is no faster.
Value* Tables::gather(llvm::Type* element, Value* memory, Value* offsets) {
  auto& ir = packet_.ir;
  llvm::Type* type = packet_.over_lanes(element);
  if (packet_.rules.bit_masks) {
    Value* all = llvm::Constant::getAllOnesValue(packet_.over_lanes(ir.getInt1Ty()));
    const llvm::Align align(element->getScalarSizeInBits() / 8);
    return ir.CreateMaskedGather(type, ir.CreateGEP(element, memory, offsets), align, all);
  }
  Value* values = llvm::PoisonValue::get(type);
  for (std::uint64_t lane = 0; lane < packet_.rules.lanes; ++lane) {
    Value* offset = ir.CreateZExt(ir.CreateExtractElement(offsets, lane), ir.getInt64Ty());
    Value* value = ir.CreateLoad(element, ir.CreateInBoundsGEP(element, memory, offset));
    values = ir.CreateInsertElement(values, value, lane);
  }
  return values;
}

void Tables::scatter(Value* memory, Value* offsets, Value* values) {
  auto& ir = packet_.ir;
  llvm::Type* element = values->getType()->getScalarType();
  if (packet_.rules.bit_masks) {
    const llvm::Align align(element->getScalarSizeInBits() / 8);
    ir.CreateMaskedScatter(values, ir.CreateGEP(element, memory, offsets), align);
    return;
  }
  for (std::uint64_t lane = 0; lane < packet_.rules.lanes; ++lane) {
    Value* offset = ir.CreateZExt(ir.CreateExtractElement(offsets, lane), ir.getInt64Ty());
    ir.CreateStore(ir.CreateExtractElement(values, lane), ir.CreateInBoundsGEP(element, memory, offset));
  }
}

// Lanes have columns of their own, so one that is not of the mask may write what it holds.
void Tables::put(const Table& table, const Index& index, Value* value, Value* mask) {
  if (!index.constant && index.value == nullptr) {
    for_each(table.type, [&](const Index& i) { put(table, i, value, mask); });
    return;
  }
  IMP_ASSERT(table.memory != nullptr && !table.shared, "a table in scratch memory");
  auto& ir = packet_.ir;
  value = packet_.widen(value);
  const auto masked = [&](Value* before) {
    return ir.CreateSelect(packet_.bits_of(mask, value->getType()->getScalarSizeInBits()), value, before);
  };
  if (index.value != nullptr && Packet::is_wide(index.value)) {
    Value* where = offsets(index.value);
    if (mask != nullptr) value = masked(gather(value->getType()->getScalarType(), table.memory, where));
    scatter(table.memory, where, value);
  } else {
    Value* where = place(table, index);
    if (mask != nullptr) value = masked(ir.CreateLoad(value->getType(), where));
    ir.CreateStore(value, where);
  }
}

}  // namespace imp
