// Runs the nodes of a Program over another kind of number: derivatives, intervals, affine forms.
#pragma once

#include <optional>

#include "ir/program.h"

namespace imp {

// Dispatches `op` to the member of `rules` with the op's name: rules.add(a, b), rules.select(c, a,
// b), … over Rules::Value, whatever that is. Nothing if `rules` has no such member: the op cannot be
// handled in this kind of number, and the caller says so at the node's span.
template <class Rules>
std::optional<typename Rules::Value> apply(Rules& rules, Op op, std::span<const typename Rules::Value> args) {
#define IMP_APPLY_0(name)
#define IMP_APPLY_1(name)                                                        \
  case Op::name:                                                                 \
    if constexpr (requires { rules.name(args[0]); }) return rules.name(args[0]); \
    break;
#define IMP_APPLY_2(name)                                                                          \
  case Op::name:                                                                                   \
    if constexpr (requires { rules.name(args[0], args[1]); }) return rules.name(args[0], args[1]); \
    break;
#define IMP_APPLY_3(name)                                              \
  case Op::name:                                                       \
    if constexpr (requires { rules.name(args[0], args[1], args[2]); }) \
      return rules.name(args[0], args[1], args[2]);                    \
    break;
  switch (op) {
#define OP(name, arity, kind, llvm, glsl, meaning) IMP_APPLY_##arity(name)
#include "ir/ops.def"
    default: break;
  }
#undef IMP_APPLY_0
#undef IMP_APPLY_1
#undef IMP_APPLY_2
#undef IMP_APPLY_3
  return std::nullopt;
}

}  // namespace imp
