// The ops of the IR: the enumeration and the table behind it, both made from ir/ops.def.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace imp {

enum class Op : std::uint8_t {
#define OP(name, arity, kind, llvm, glsl, meaning) name,
#include "ir/ops.def"
};

enum class OpKind : std::uint8_t {
  real,
  elementary,
  upward,
  compare,
  logic,
  choice,
  convert,
  packet,
  structure,
};

struct OpInfo {
  std::string_view name;  // in the text form
  int arity;
  OpKind kind;
  std::string_view llvm;     // builder in backends/llvm, empty where there is none
  std::string_view glsl;     // spelling with $a, $b, $c, empty where there is none
  std::string_view meaning;  // C++ text of the last column
};

inline constexpr int op_count = 0
#define OP(name, arity, kind, llvm, glsl, meaning) +1
#include "ir/ops.def"
    ;

const OpInfo& info(Op op);
std::optional<Op> op_named(std::string_view name);

// Where the order of two operands does not matter, NaN and signed zeros included.
constexpr bool commutes(Op op) {
  return op == Op::add || op == Op::mul || op == Op::add_up || op == Op::mul_up || op == Op::eq ||
         op == Op::and_ || op == Op::or_;
}

// Whether all operands but the first are constant integers.
constexpr bool takes_integers(Op op) { return op == Op::powi || op == Op::chebyshev; }

// True where a Program with this op rounds upward throughout (design: plain ops are then faithful).
constexpr bool rounds_up(Op op) {
  return op == Op::add_up || op == Op::mul_up || op == Op::div_up || op == Op::sqrt_up || op == Op::fma_up ||
         op == Op::narrow_up;
}

}  // namespace imp
