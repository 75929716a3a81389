// What is fixed before a Program runs: the order of its nodes, where its tables lie, which of its
// call nodes are one call.
#pragma once

#include <memory>
#include <unordered_map>
#include <vector>

#include "ir/regions.h"

namespace imp {

struct Plan {
  explicit Plan(const Program& run);  // which must outlive the plan

  const Program& program;

  // The nodes of every region, in order. Of the nodes of one call (same callee, same operands) only
  // the first is here; `calls` has all of them.
  std::vector<std::vector<Id>> schedule;
  std::unordered_map<Id, std::vector<Id>> calls;
  std::vector<std::unique_ptr<Plan>> callees;

  // The value every node starts with: the bits of a constant, the place of a table's first element
  // in the frame's tables.
  std::vector<std::uint64_t> start;
  std::size_t table_elements = 0;
};

}  // namespace imp
