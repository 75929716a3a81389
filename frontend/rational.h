// Constant sub-expressions as exact fractions. What has to be an integer (an exponent, a degree, the bound
// of a sum) is decided by them, as no double shows that 0.3/0.1 is 3.
#pragma once

#include <gmpxx.h>

#include <optional>
#include <unordered_map>
#include <vector>

#include "ir/graph.h"

namespace imp::syntax {

// The values of the nodes of a graph that may grow.
class Rationals {
 public:
  explicit Rationals(const Graph& graph) : graph_(graph) {}

  // Nothing where the node has no value, or none that the ops of ir/ops.def make of fractions by fractions of
  // at most `most_bits`: sums, products, quotients, powers, exact roots, roundings, choices.
  std::optional<mpq_class> operator()(Id node);

  static constexpr std::size_t most_bits = 1024;  // of a numerator or a denominator

  // A number or a truth, where it is known.
  struct Value {
    std::optional<mpq_class> number{};
    std::optional<bool> truth{};
  };

 private:
  std::vector<Id> unseen_operands(Id node);
  Value known(Id node) const;
  Value value(Id node) const;

  const Graph& graph_;
  std::vector<bool> seen_;                // by node
  std::unordered_map<Id, Value> values_;  // those that are known, of nodes seen
};

}  // namespace imp::syntax
