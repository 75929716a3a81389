#include "tools/op_counts.h"

#include <algorithm>
#include <array>

#include "ir/op.h"
#include "ir/regions.h"

namespace imp::tools {
namespace {

std::string name_of(const Program& program, Region region) {
  if (region == Region::constant()) return "constant";
  if (region == Region::of(Rate::frame)) return "frame";
  if (region == Region::of(Rate::cell)) return "cell";
  if (region == Region::of(Rate::ray)) return "ray";
  const std::string& phase = program.phases[(region.rank - 4) / 2].name;
  return region.inside_a_phase() ? phase : "after " + phase;
}

using Counts = std::array<std::size_t, op_count>;

}  // namespace

Table op_counts(const Program& program) {
  Counts total{};
  std::vector<std::pair<std::string, Counts>> columns;
  const auto by_region = schedule(program);
  for (std::uint32_t rank = 0; rank < by_region.size(); ++rank) {
    Counts counts{};
    for (const Id id : by_region[rank]) {
      const auto op = static_cast<std::size_t>(program.graph[id].op);
      ++counts[op];
      ++total[op];
    }
    if (!by_region[rank].empty()) columns.emplace_back(name_of(program, Region{rank}), counts);
  }
  if (columns.empty()) return {};
  columns.emplace_back("total", total);

  std::vector<std::size_t> ops;
  for (std::size_t op = 0; op < total.size(); ++op)
    if (total[op] > 0) ops.push_back(op);
  std::ranges::sort(ops, {},
                    [&](std::size_t op) { return std::pair(-static_cast<std::ptrdiff_t>(total[op]), op); });

  Table table{{"op"}};
  for (const std::size_t op : ops) table.push_back({std::string(info(static_cast<Op>(op)).name)});
  table.push_back({"total"});
  for (const auto& [name, counts] : columns) {
    table.front().push_back(name);
    std::size_t sum = 0;
    for (std::size_t i = 0; i < ops.size(); ++i) {
      const std::size_t count = counts[ops[i]];
      table[i + 1].push_back(count == 0 ? "" : std::to_string(count));
      sum += count;
    }
    table.back().push_back(std::to_string(sum));
  }
  return table;
}

}  // namespace imp::tools
