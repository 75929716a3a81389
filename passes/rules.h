// Algebra as text: rules like "select c select c a b d" -> "select c a d", one a line.
//
// Terms are written in prefix form with the names of ops.def. A letter stands for any node, the same
// one wherever it occurs; k is a constant number; 1, -1, true and so on are themselves.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "ir/graph.h"

namespace imp {

struct AlgebraRule {
  std::string_view from, to;
  bool (*when)(double k) = nullptr;  // where set: must hold for k
};

struct Term {
  enum class Kind : std::uint8_t { op, any, constant, number, boolean } kind;
  Op op = Op::constant;  // of an op
  char letter = 0;       // of what stands for any node, or for a constant
  double value = 0;      // of a number or a boolean
  std::vector<Term> args;
};

Term parse_term(std::string_view text);

// What builds nodes by rules. These must lead to an end: each makes a term smaller, or settles it.
class Algebra {
 public:
  explicit Algebra(std::span<const AlgebraRule> rules);

  // `op` over `args`, by as many rules as apply.
  Id add(Graph& graph, Op op, std::span<const Id> args) const;

 private:
  struct Parsed {
    Term from, to;
    bool (*when)(double);
  };
  std::array<std::vector<Parsed>, op_count> rules_;  // by the first op
};

// The ids that letters stand for.
class Letters {
 public:
  Id& operator[](char letter) { return ids_[static_cast<std::size_t>(letter - 'a')]; }
  Id operator[](char letter) const { return ids_[static_cast<std::size_t>(letter - 'a')]; }

 private:
  std::array<Id, 26> ids_;
};

// `term` as nodes; its numbers are of type `type`. The ops are added by `algebra` where there is one.
Id build(Graph& graph, const Term& term, const Letters& letters, Type type, const Algebra* algebra = nullptr);

}  // namespace imp
