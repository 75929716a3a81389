// Tables of a packet. A small one, or one with constant indices only, lies in registers; others in memory:
// shared by all rays (an input), or scratch memory with a column for each lane.
//
// Tables are values, memory is not: a table in memory is the memory as it was, and the stores since then.
// A load looks through these stores, so nothing is written before the end of a phase's step.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "backends/llvm/packet.h"
#include "ir/type.h"

namespace imp {

struct Index {
  std::optional<std::uint32_t> constant;
  llvm::Value* value = nullptr;  // i32, one for all rays or one a ray; null with a constant: every element
};

struct Table {
  struct Store {
    Index index;
    llvm::Value* value;
  };

  Type type;
  std::vector<llvm::Value*> elements;  // in registers: all of them
  llvm::Value* memory = nullptr;       // null where the first store fills the table
  bool shared = false;
  std::vector<Store> stores;

  bool in_registers() const { return !elements.empty(); }
};

class Tables {
 public:
  static constexpr std::uint32_t short_length = 4;  // up to this length a choice beats memory

  explicit Tables(Packet& packet) : packet_(packet) {}

  // A number as an index: rounded down, clamped, 0 for NaN.
  Index index(Type table, llvm::Value* number);

  static Table in_registers(Type type, std::vector<llvm::Value*> elements);
  static Table in_memory(Type type, llvm::Value* memory, bool shared);
  Table fill(Type type, llvm::Value* value, bool registers);
  Table store(Table table, const Index& index, llvm::Value* value, bool registers);
  llvm::Value* load(const Table& table, const Index& index);

  // A table in scratch memory of its own with the values of `table`.
  Table keep(const Table& table);
  Table to_registers(const Table& table);  // all elements wide

  // Brings the memory of `state` to the values of `next`, for the rays of `mask`. Where `next` does not start
  // from the memory of `state`, it must have been kept elsewhere.
  void update(const Table& state, const Table& next, llvm::Value* mask);

 private:
  void for_each(Type type, const std::function<void(const Index&)>& body);
  llvm::Type* element_type(Type type) const;
  llvm::Value* is_at(const Index& index, const Index& place);
  llvm::Value* choose(llvm::Value* bits, llvm::Value* a, llvm::Value* b);
  llvm::Value* element_in_memory(const Table& table, const Index& index);
  llvm::Value* one_of(const std::vector<llvm::Value*>& elements, const Index& index);
  llvm::Value* place(const Table& table, const Index& index);
  llvm::Value* offsets(llvm::Value* index);
  llvm::Value* gather(llvm::Type* element, llvm::Value* memory, llvm::Value* offsets);
  void scatter(llvm::Value* memory, llvm::Value* offsets, llvm::Value* values);
  void put(const Table& table, const Index& index, llvm::Value* value, llvm::Value* mask);

  Packet& packet_;
};

}  // namespace imp
