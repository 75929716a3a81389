// What a Program costs: how many ops live in it, leaves aside.
#pragma once

#include "ir/program.h"

namespace imp::test {

inline std::size_t cost(const Program& program) {
  const Program live = compact(program);
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < live.graph.size(); ++i)
    count += info(live.graph[Id{i}].op).kind != OpKind::structure;
  return count;
}

}  // namespace imp::test
