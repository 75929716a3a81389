// The expression graph: an arena of hash-consed nodes.
//
// Building is deduplicating: equal nodes have equal ids. Ids grow and operands come before users,
// so "walk in order" is a for loop. Folds are exact: same bits in either rounding mode, NaN and
// signed zeros included, and nothing that is not representable is ever folded (1/10 stays a
// division, so that an enclosure of it can still be made). An upward op of two constants folds to
// what the op means, the constant rounded upward.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "ir/op.h"
#include "ir/span.h"
#include "ir/type.h"

namespace imp {

struct Id {
  std::uint32_t index = ~0u;

  constexpr bool valid() const { return index != ~0u; }
  friend constexpr auto operator<=>(Id, Id) = default;
};

// `payload` by op:
//   constant  the bits of the value (an f32 in the low half; truth: 0 or 1)
//   input     index into Program::inputs
//   state     phase << 32 | index into Phase::states: the value inside the phase
//   result    the same, but the value after the phase has ended
//   call      callee << 32 | output: one node an output, same operands; a backend calls once
struct Node {
  Op op = Op::constant;
  Type type;
  std::uint64_t payload = 0;
  std::span<const Id> args;

  std::uint32_t high() const { return static_cast<std::uint32_t>(payload >> 32); }
  std::uint32_t low() const { return static_cast<std::uint32_t>(payload); }
};

constexpr std::uint64_t pair_of(std::uint32_t high, std::uint32_t low) {
  return std::uint64_t{high} << 32 | low;
}

class Graph {
 public:
  // The id of `op` over `args`, folded or shared where possible. The type follows from the
  // operands; operands of the wrong number or type are an assertion.
  Id add(Op op, std::span<const Id> args);
  Id add(Op op, std::initializer_list<Id> args) { return add(op, std::span(args.begin(), args.size())); }

  Id constant(Type type, double value);  // rounded to nearest where type is f32
  Id constant(bool value);
  Id leaf(Op op, Type type, std::uint64_t payload);  // input, state, result
  Id fill(Type table, Id value);
  Id call(Type type, std::uint32_t callee, std::uint32_t output, std::span<const Id> args);

  std::size_t size() const { return nodes_.size(); }
  Node operator[](Id id) const;

  // The value of a constant node, as a double (exact); nothing for other nodes.
  std::optional<double> number(Id id) const;
  std::optional<bool> truth_value(Id id) const;
  bool is_number(Id id, double value) const;  // same value and same sign of zero

  // Where a node came from and what its author called it: for diagnostics and for reading. Neither
  // takes part in equality; the first one given stays.
  void set_span(Id id, Span span);
  void set_name(Id id, std::string_view name);
  Span span(Id id) const;
  std::string_view name(Id id) const;

 private:
  struct Stored {
    Op op;
    Type type;
    std::uint64_t payload;
    std::uint32_t first, count;
    std::uint32_t hash;
  };

  Id intern(Op op, Type type, std::uint64_t payload, std::span<const Id> args);
  std::optional<Id> fold(Op op, Type type, std::span<const Id> args);
  std::optional<Id> fold_constants(Op op, Type type, std::span<const Id> args);
  bool same(const Stored& stored, Op op, Type type, std::uint64_t payload, std::span<const Id> args) const;
  void enlarge_table();

  std::vector<Stored> nodes_;
  std::vector<Id> operands_;
  std::vector<Id> unique_;  // by hash, open addressing: a power of 2 in size, at most half of it used
  std::vector<Span> spans_;
  std::unordered_map<std::uint32_t, std::string> names_;
};

// `node`, of another graph, in `graph` over `args` and with `payload`: folded and shared there.
Id rebuild(Graph& graph, const Node& node, std::span<const Id> args, std::uint64_t payload);

// The type of `op` over operands of these types, or nothing where they do not fit.
std::optional<Type> type_of(Op op, std::span<const Type> args);

}  // namespace imp

template <>
struct std::hash<imp::Id> {
  std::size_t operator()(imp::Id id) const noexcept { return id.index; }
};
