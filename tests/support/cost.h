// What a Program costs.
#pragma once

#include "ir/program.h"

namespace imp::test {

// How many ops live in it, leaves aside.
inline std::size_t cost(const Program& program) {
  const Program live = compact(program);
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < live.graph.size(); ++i)
    count += info(live.graph[Id{i}].op).kind != OpKind::structure;
  return count;
}

// How often this op lives in it.
inline int count(const Program& program, Op op) {
  const Program live = compact(program);
  int n = 0;
  for (std::uint32_t i = 0; i < live.graph.size(); ++i) n += live.graph[Id{i}].op == op;
  return n;
}

}  // namespace imp::test
