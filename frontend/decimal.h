// Numbers as they are written: 0.1 is one tenth, and no double.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "ir/graph.h"

namespace imp::syntax {

// digits * 10^exponent, exactly.
struct Decimal {
  std::string digits;  // without leading zeros; empty for 0
  int exponent = 0;
};

// The value of a NUMBER; nothing if it is out of the range of doubles or has too many digits.
std::optional<Decimal> parse_decimal(std::string_view text);

// The same as a node of type f64: constants that doubles hold, and exact powers of ten between them.
Id lower(const Decimal& decimal, Graph& graph);

}  // namespace imp::syntax
