// How LLVM spells an op: one builder for each name in the llvm column of ir/ops.def.
#pragma once

#include <span>
#include <string_view>

#include "backends/llvm/packet.h"

namespace imp {

// The operands are all wide or all the same for every ray. "any" and "all" speak for packet.active.
using OpBuilder = llvm::Value* (*)(Packet& packet, std::span<llvm::Value* const> args);

OpBuilder op_builder(std::string_view name);  // null where there is none

}  // namespace imp
