// Regions: how often a node must be evaluated. A node lives in the outermost region where its
// operands live, so loop-invariant code is hoisted for every backend, here, once.
//
//   constant < frame < cell < ray < in phase 0 < after phase 0 < in phase 1 < …
//
// A node "in phase i" sees the states of phase i; one "after phase i" sees its results. `init` and
// `enter` of phase i live before it, `next` and `again` inside it or before it.
#pragma once

#include <vector>

#include "ir/program.h"

namespace imp {

struct Region {
  std::uint32_t rank = 0;

  static constexpr Region constant() { return {0}; }
  static constexpr Region of(Rate rate) { return {1 + static_cast<std::uint32_t>(rate)}; }
  static constexpr Region in_phase(std::size_t i) { return {4 + 2 * static_cast<std::uint32_t>(i)}; }
  static constexpr Region after_phase(std::size_t i) { return {5 + 2 * static_cast<std::uint32_t>(i)}; }

  constexpr bool inside_a_phase() const { return rank >= 4 && rank % 2 == 0; }
  friend constexpr auto operator<=>(Region, Region) = default;
};

// The region of every node, by index.
std::vector<Region> regions(const Program& program);

// The nodes that outputs and phases need, by region and in order within: what a backend prints.
// Entry r of the result holds the nodes of Region{r}; constants are left out unless computed.
std::vector<std::vector<Id>> schedule(const Program& program);

}  // namespace imp
