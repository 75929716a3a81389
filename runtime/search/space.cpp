#include "runtime/search/space.h"

#include <cmath>

namespace imp {

// A thousandth is what the rounding of places comes to from about a thousand sizes of the box away.
SpaceBounds with_margin(const SpaceBounds& space) {
  SpaceBounds result = space;
  for (Range& axis : result) {
    const double margin = 1e-3 * (std::abs(axis.lo) + std::abs(axis.hi) + axis.hi - axis.lo);
    axis = {axis.lo - margin, axis.hi + margin};
  }
  return result;
}

std::vector<Range> ranges_in(const SpaceBounds& space, const Program& f) {
  const SpaceBounds places = with_margin(space);
  std::vector<Range> ranges(places.begin(), places.end());
  ranges.resize(f.inputs.size(), everything);
  return ranges;
}

// A way leads from one place in the box with its margin to another.
std::vector<Range> ranges_along_ray(const SpaceBounds& space, const Program& f) {
  const SpaceBounds places = with_margin(space);
  std::vector<Range> result{{0, 1}};
  result.insert(result.end(), places.begin(), places.end());
  for (const Range& axis : places) {
    const double width = 1.001 * (axis.hi - axis.lo);
    result.push_back({-width, width});
  }
  result.resize(result.size() + f.inputs.size() - 3, everything);
  return result;
}

Truth lies_in(const Segment& segment, const SpaceBounds& space) {
  Truth all = truth_of(*segment.exists.graph, true);  // so far
  const auto require = [&](Expr value, double most) {
    all = all && value <= -rounded_up(*value.graph, value.type(), -most);
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const Interval &begin = segment.origin_bounds[i], &way = segment.direction_bounds[i];
    require(begin.hi, space[i].hi);
    require(begin.nlo, -space[i].lo);
    require(add_up(begin.hi, way.hi), space[i].hi);
    require(add_up(begin.nlo, way.nlo), -space[i].lo);
  }
  return all || !segment.exists;
}

}  // namespace imp
