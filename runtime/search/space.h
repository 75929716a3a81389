// Where rays are searched, as far as it is known before anything runs.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "passes/range.h"
#include "runtime/search/search.h"

namespace imp {

// A box that the segments will not leave, as far as it is known before anything runs.
using SpaceBounds = std::array<Range, 3>;

// The same box with room for what rounding makes of places in it.
SpaceBounds with_margin(const SpaceBounds& space);

// The ranges there of the inputs of an f: x, y, z, then uniforms.
std::vector<Range> ranges_in(const SpaceBounds& space, const Program& f);

// And of those of along_ray(f): s, o, d, uniforms. Both ends of the segment lie in `space`.
std::vector<Range> ranges_along_ray(const SpaceBounds& space, const Program& f);

// Whether all of a segment, if there is one, lies in a box; not where that is not known.
Truth lies_in(const Segment& segment, const SpaceBounds& space);

struct SearchSpace {
  SpaceBounds box;
  std::optional<double> economize;  // how far f may be from the polynomial that is enclosed for it
};

}  // namespace imp
