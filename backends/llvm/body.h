// The nodes of one Program as the code of one LLVM function: the walk over its regions and phases.
#pragma once

#include <map>
#include <unordered_map>

#include "backends/llvm/tables.h"
#include "ir/program.h"

namespace imp {

// How an argument of a call is passed. Functions are made for the forms that occur.
enum class Form : std::uint8_t { scalar, wide, shared_table, lane_table };

class Body {
 public:
  // Gives the function of a callee: (mask, arguments…) -> a struct of its outputs, all wide.
  using Callees = std::function<llvm::Function*(const Program&, const std::vector<Form>&)>;

  Body(Packet& packet, const Program& program, Callees callees);

  // Whether anything needs the input.
  bool needs(const Input& input) const { return needed_[input.id.index]; }
  void set(Id id, llvm::Value* value) { values_[id.index] = value; }
  void set(Id id, Table table) { tables_of_[id.index] = std::move(table); }

  void emit_before_rays();  // what is the same for all rays, unless called with more
  void emit_rays();         // the rest, for the rays of packet.active
  llvm::Value* value(Id id);

 private:
  struct Slot;

  void compute(std::span<const Id> nodes);
  void compute(Id id);
  void call(Id id, const Node& node);
  llvm::Value* call_of(const Node& node);
  void phase(std::size_t number);
  const Table& table(Id id) { return tables_of_.at(id.index); }
  Index index(Id table, Id number);
  void name(llvm::Value* value, std::string_view text);

  Packet& packet_;
  const Program& program_;
  Callees callees_;
  Tables tables_;
  std::vector<std::vector<Id>> schedule_;
  std::vector<bool> needed_;
  std::vector<bool> in_registers_;  // of table nodes
  std::vector<llvm::Value*> values_;
  std::unordered_map<std::uint32_t, Table> tables_of_;
  std::map<std::pair<std::uint32_t, std::vector<Id>>, llvm::Value*> calls_;  // by callee and arguments
};

}  // namespace imp
