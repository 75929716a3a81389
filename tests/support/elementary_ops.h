// The elementary functions of ir/ops.def: a new one is tested by being there.
#pragma once

#include <vector>

#include "ir/op.h"

namespace imp::test {

inline std::vector<Op> elementary_ops() {
  std::vector<Op> result;
  for (int i = 0; i < op_count; ++i)
    if (const Op op = static_cast<Op>(i); info(op).kind == OpKind::elementary) result.push_back(op);
  return result;
}

}  // namespace imp::test
