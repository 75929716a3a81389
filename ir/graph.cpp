#include "ir/graph.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "ir/assert.h"

namespace imp {
namespace {

std::size_t mix(std::size_t seed, std::uint64_t value) {
  return (seed ^ (value + 0x9e3779b97f4a7c15u + (seed << 6) + (seed >> 2))) * 0xff51afd7ed558ccdu;
}

// All of it counts: its low bits find the slot.
std::uint32_t hash_of(Op op, Type type, std::uint64_t payload, std::span<const Id> args) {
  std::size_t seed = mix(static_cast<std::size_t>(op), static_cast<std::uint64_t>(type.scalar));
  seed = mix(mix(seed, type.length), payload);
  for (const Id arg : args) seed = mix(seed, arg.index);
  return static_cast<std::uint32_t>(seed >> 32);
}

std::uint64_t bits_of(Type type, double value) {
  if (std::isnan(value)) value = std::numeric_limits<double>::quiet_NaN();
  if (type == f32) return std::bit_cast<std::uint32_t>(static_cast<float>(value));
  return std::bit_cast<std::uint64_t>(value);
}

}  // namespace

std::optional<Type> type_of(Op op, std::span<const Type> args) {
  const auto all_equal_reals = [&] {
    return std::ranges::all_of(args, [&](Type t) { return t.is_real() && t == args[0]; });
  };
  if (op != Op::call && args.size() != static_cast<std::size_t>(info(op).arity)) return std::nullopt;
  switch (info(op).kind) {
    case OpKind::real:
    case OpKind::elementary:
    case OpKind::upward:     return all_equal_reals() ? std::optional(args[0]) : std::nullopt;
    case OpKind::compare:    return all_equal_reals() ? std::optional(truth) : std::nullopt;
    case OpKind::logic:
    case OpKind::packet:
      return std::ranges::all_of(args, &Type::is_truth) ? std::optional(truth) : std::nullopt;
    case OpKind::choice:
      return args[0].is_truth() && args[1].is_real() && args[1] == args[2] ? std::optional(args[1])
                                                                           : std::nullopt;
    case OpKind::convert: {
      const Type from = op == Op::widen ? f32 : f64;
      return args[0] == from ? std::optional(op == Op::widen ? f64 : f32) : std::nullopt;
    }
    case OpKind::structure:
      if (op == Op::load && args[0].is_table() && args[1].is_real()) return args[0].element();
      if (op == Op::store && args[0].is_table() && args[1].is_real() && args[2] == args[0].element())
        return args[0];
      return std::nullopt;
  }
  return std::nullopt;
}

Node Graph::operator[](Id id) const {
  const Stored& n = nodes_[id.index];
  return {n.op, n.type, n.payload, std::span(operands_).subspan(n.first, n.count)};
}

Id Graph::add(Op op, std::span<const Id> args) {
  std::array<Type, 3> types;
  IMP_ASSERT(args.size() <= types.size(), "at most three operands");
  for (std::size_t i = 0; i < args.size(); ++i) {
    IMP_ASSERT(args[i].index < nodes_.size(), "an operand of this graph");
    types[i] = nodes_[args[i].index].type;
  }
  const auto type = type_of(op, std::span(types).first(args.size()));
  IMP_ASSERT(type.has_value(), "operands of the types that the op takes");

  if (auto known = fold(op, *type, args)) return *known;
  if (commutes(op) && args[1] < args[0]) return intern(op, *type, 0, std::array{args[1], args[0]});
  return intern(op, *type, 0, args);
}

Id Graph::constant(Type type, double value) {
  IMP_ASSERT(type.is_real(), "a number type");
  return intern(Op::constant, type, bits_of(type, value), {});
}

Id Graph::constant(bool value) { return intern(Op::constant, truth, value ? 1 : 0, {}); }

Id Graph::leaf(Op op, Type type, std::uint64_t payload) {
  IMP_ASSERT(op == Op::input || op == Op::state || op == Op::result, "a leaf");
  return intern(op, type, payload, {});
}

Id Graph::fill(Type table, Id value) {
  IMP_ASSERT(table.is_table() && (*this)[value].type == table.element(), "a table and its element");
  return intern(Op::fill, table, 0, std::array{value});
}

Id Graph::call(Type type, std::uint32_t callee, std::uint32_t output, std::span<const Id> args) {
  return intern(Op::call, type, pair_of(callee, output), args);
}

std::optional<double> Graph::number(Id id) const {
  const Stored& n = nodes_[id.index];
  if (n.op != Op::constant || !n.type.is_real()) return std::nullopt;
  if (n.type == f32) return std::bit_cast<float>(static_cast<std::uint32_t>(n.payload));
  return std::bit_cast<double>(n.payload);
}

std::optional<bool> Graph::truth_value(Id id) const {
  const Stored& n = nodes_[id.index];
  if (n.op != Op::constant || !n.type.is_truth()) return std::nullopt;
  return n.payload != 0;
}

bool Graph::is_number(Id id, double value) const {
  const Stored& n = nodes_[id.index];
  return n.op == Op::constant && n.type.is_real() && n.payload == bits_of(n.type, value);
}

void Graph::set_span(Id id, Span span) {
  if (!span.valid() || this->span(id).valid()) return;
  if (spans_.size() <= id.index) spans_.resize(nodes_.size());
  spans_[id.index] = span;
}

void Graph::set_name(Id id, std::string_view name) {
  if (!name.empty()) names_.try_emplace(id.index, name);
}

Span Graph::span(Id id) const { return id.index < spans_.size() ? spans_[id.index] : Span{}; }

std::string_view Graph::name(Id id) const {
  const auto it = names_.find(id.index);
  return it == names_.end() ? std::string_view{} : it->second;
}

bool Graph::same(const Stored& stored, Op op, Type type, std::uint64_t payload,
                 std::span<const Id> args) const {
  return stored.op == op && stored.type == type && stored.payload == payload &&
         std::ranges::equal(std::span(operands_).subspan(stored.first, stored.count), args);
}

Id Graph::intern(Op op, Type type, std::uint64_t payload, std::span<const Id> args) {
  if (unique_.size() <= 2 * nodes_.size()) enlarge_table();
  const std::uint32_t hash = hash_of(op, type, payload, args);
  const std::size_t mask = unique_.size() - 1;
  std::size_t slot = hash & mask;
  for (; unique_[slot].valid(); slot = (slot + 1) & mask) {
    const Stored& known = nodes_[unique_[slot].index];
    if (known.hash == hash && same(known, op, type, payload, args)) return unique_[slot];
  }

  const Id id{static_cast<std::uint32_t>(nodes_.size())};
  const auto begin = static_cast<std::uint32_t>(operands_.size());
  const std::vector<Id> copy(args.begin(), args.end());  // args may point into operands_
  operands_.insert(operands_.end(), copy.begin(), copy.end());
  nodes_.push_back({op, type, payload, begin, static_cast<std::uint32_t>(copy.size()), hash});
  return unique_[slot] = id;
}

void Graph::enlarge_table() {
  unique_.assign(std::max<std::size_t>(64, 2 * unique_.size()), Id{});
  const std::size_t mask = unique_.size() - 1;
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    std::size_t slot = nodes_[i].hash & mask;
    while (unique_[slot].valid()) slot = (slot + 1) & mask;
    unique_[slot] = Id{i};
  }
}

Id rebuild(Graph& graph, const Node& node, std::span<const Id> args, std::uint64_t payload) {
  switch (node.op) {
    case Op::constant:
      if (node.type.is_truth()) return graph.constant(payload != 0);
      return graph.constant(node.type, node.type == f32
                                           ? std::bit_cast<float>(static_cast<std::uint32_t>(payload))
                                           : std::bit_cast<double>(payload));
    case Op::input:
    case Op::state:
    case Op::result: return graph.leaf(node.op, node.type, payload);
    case Op::fill:   return graph.fill(node.type, args[0]);
    case Op::call:   return graph.call(node.type, node.high(), node.low(), args);
    default:         return graph.add(node.op, args);
  }
}

}  // namespace imp
