#include "passes/reassociate.h"

#include <algorithm>
#include <bit>
#include <map>

#include "passes/chains.h"
#include "passes/rewrite.h"

namespace imp {
namespace {

// How long a chain takes in one region: ops, and how many of them wait for each other.
struct Length {
  std::size_t ops = 0, depth = 0;
  friend bool operator==(const Length&, const Length&) = default;
};
using Lengths = std::map<Region, Length>;

class Reassociation {
 public:
  explicit Reassociation(const Program& program)
      : old_(program.graph), chains_(program), regions_(regions(program)), now_(program.graph.size()) {}

  Id operator()(Graph& graph, Id old, const Node& node) {
    const bool is_sum = chains_.is_sum(old);
    Id result;
    if (is_sum || chains_.is_product(old)) {
      const auto groups = groups_of(old, graph);
      if (lengths_of(groups) != lengths_of(old)) result = is_sum ? sum(groups) : product(groups);
    }
    return now_[old.index] = result.valid() ? result : copy(graph, node);
  }

 private:
  using Group = std::vector<Signed>;
  using Groups = std::map<Region, Group>;  // from the outermost region to the innermost

  Groups groups_of(Id chain, Graph& graph) const {
    Groups groups;
    for (const Operand& operand : chains_.operands(chain))
      groups[regions_[operand.id.index]].push_back({{&graph, now_[operand.id.index]}, operand.negative});
    return groups;
  }

  // Of the chain as it is.
  Lengths lengths_of(Id chain) const {
    Lengths lengths;
    std::map<Id, std::size_t> depths;
    for (const Id part : chains_.parts(chain)) {
      const Region region = regions_[part.index];
      const bool is_op = old_[part].op != Op::neg;
      std::size_t depth = is_op ? 1 : 0;
      for (const Id arg : old_[part].args)
        if (const auto below = depths.find(arg); below != depths.end() && regions_[arg.index] == region)
          depth = std::max(depth, below->second + (is_op ? 1 : 0));
      depths[part] = depth;
      lengths[region].ops += is_op ? 1 : 0;
      lengths[region].depth = std::max(lengths[region].depth, depth);
    }
    std::erase_if(lengths, [](const auto& entry) { return entry.second.ops == 0; });
    return lengths;
  }

  // Of the trees that `sum` and `product` make.
  static Lengths lengths_of(const Groups& groups) {
    Lengths lengths;
    std::size_t before = 0;  // one operand, once there is anything
    for (const auto& [region, group] : groups) {
      const std::size_t operands = group.size() + before;
      if (operands > 1)
        lengths[region] = {operands - 1, static_cast<std::size_t>(std::bit_width(operands - 1))};
      before = 1;
    }
    return lengths;
  }

  static Id sum(const Groups& groups) {
    return tree(groups, [](const Signed& a, const Signed& b) { return a + b; }).resolved().id;
  }

  static Id product(const Groups& groups) {
    return tree(groups, [](const Signed& a, const Signed& b) { return Signed{a.value * b.value}; }).value.id;
  }

  template <class Join>
  static Signed tree(const Groups& groups, Join join) {
    Group level;
    for (const auto& [region, group] : groups) {
      level.insert(level.end(), group.begin(), group.end());
      while (level.size() > 1) {
        Group next;
        for (std::size_t i = 0; i < level.size(); i += 2)
          next.push_back(i + 1 < level.size() ? join(level[i], level[i + 1]) : level[i]);
        level = std::move(next);
      }
    }
    return level[0];
  }

  const Graph& old_;
  Chains chains_;
  std::vector<Region> regions_;
  std::vector<Id> now_;  // of the nodes so far
};

}  // namespace

// Until nothing changes: parts of two trees may become one and the same, which is then shared.
Program reassociate(const Program& program) {
  Program result = program;
  for (int rounds = 0; rounds < 16; ++rounds) {
    Program next = rewrite(result, Reassociation(result));
    if (next == result) break;
    result = std::move(next);
  }
  return result;
}

}  // namespace imp
