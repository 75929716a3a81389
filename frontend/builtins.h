// The functions and constants that need no definition.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "ir/op.h"

namespace imp::syntax {

// How a built-in is lowered.
enum class Meaning : std::uint8_t {
  op,         // one op over its arguments
  fold,       // one op, from left to right over two or more arguments
  power,      // like ^
  choice,     // if: a condition and two numbers
  chebyshev,  // T(n, e)
  series,     // sum, product: an index, its first and last value, a body
  pi,
};

struct Builtin {
  std::string_view name;
  Meaning meaning;
  Op op;
  std::uint32_t arity;  // 0: a constant; for a fold the least number of arguments
};

std::span<const Builtin> builtins();
const Builtin* find_builtin(std::string_view name);  // null: there is none

}  // namespace imp::syntax
