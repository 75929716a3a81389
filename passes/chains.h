// Sums and products of many operands, which the IR has as chains of ops with two.
#pragma once

#include <vector>

#include "ir/expr.h"
#include "ir/program.h"
#include "ir/regions.h"

namespace imp {

struct Operand {
  Id id;
  bool negative = false;  // in a sum: subtracted
};

// The sums of a Program, made of plain add, sub and neg, and its products, made of plain mul. What has
// further users is an operand and never a part of a chain, so it stays shared; so are constant
// sub-expressions and squares.
class Chains {
 public:
  explicit Chains(const Program& program);

  // Whether the node is a sum or a product, and not a part of a larger one.
  bool is_sum(Id id) const;
  bool is_product(Id id) const;

  bool is_shared(Id id) const { return users_[id.index] > 1; }
  bool is_part(Id id) const { return part_[id.index]; }

  std::vector<Operand> operands(Id chain) const;  // from left to right
  std::vector<Id> parts(Id chain) const;          // operands before users

 private:
  enum class Kind : std::uint8_t { none, sum, product };
  Kind kind(Id id) const;

  const Graph& graph_;
  std::vector<Region> regions_;
  std::vector<std::uint32_t> users_;
  std::vector<bool> part_;
};

// A number and a sign that is still to be applied.
struct Signed {
  Expr value;
  bool negative = false;

  Expr resolved() const { return negative ? -value : value; }
};

// Without an op for the signs.
Signed operator+(const Signed& a, const Signed& b);

}  // namespace imp
