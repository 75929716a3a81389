#include "ir/op.h"

#include <array>

namespace imp {
namespace {

constexpr std::string_view without_underscore(std::string_view name) {
  return name.ends_with('_') ? name.substr(0, name.size() - 1) : name;
}

constexpr std::array<OpInfo, op_count> table{{
#define OP(name, arity, kind, llvm, glsl, meaning) \
  {without_underscore(#name), arity, OpKind::kind, llvm, glsl, #meaning},
#include "ir/ops.def"
}};

}  // namespace

const OpInfo& info(Op op) { return table[static_cast<std::size_t>(op)]; }

std::optional<Op> op_named(std::string_view name) {
  for (std::size_t i = 0; i < table.size(); ++i)
    if (table[i].name == name) return static_cast<Op>(i);
  return std::nullopt;
}

}  // namespace imp
