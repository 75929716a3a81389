// From rays and formulas to what a strategy is given.
#pragma once

#include <optional>
#include <span>

#include "ir/diagnostics.h"
#include "passes/extend/inclusion.h"
#include "runtime/search/search.h"
#include "runtime/search/space.h"

namespace imp {

// A uniform of f in a kernel: its enclosure, the same in f64, and its nearest number.
struct Uniform {
  Interval bounds, wide_bounds;
  Expr value;
};

// A double as a uniform of a kernel of type `type`.
Uniform uniform(Expr value, Type type);

// The segment o + t d, tmin <= t <= tmax, of exactly these doubles, for a kernel of type `type`.
Segment segment_of_ray(const std::array<Expr, 3>& o, const std::array<Expr, 3>& d, Expr tmin, Expr tmax,
                       Type type);

// The segment of a ray in the kernel's own type; it is what its numbers say.
Segment segment_of_numbers(const std::array<Expr, 3>& o, const std::array<Expr, 3>& d, Expr near, Expr far);

// f (inputs x, y, z, then uniforms; f64) along the segment. Errors where f has no derivative or no
// rule in the inclusion. The functions build into the segment's graph and share sub-expressions.
std::optional<RayFunction> ray_function(const Program& f, const Segment& segment,
                                        std::span<const Uniform> uniforms, const Inclusion& inclusion,
                                        const std::optional<SearchSpace>& space, Diagnostics& diagnostics);

// The gradient of f there, at s, scaled to length 1 in the kernel's type; no numbers where it is 0 or f has none.
std::optional<std::array<Expr, 3>> normal_at(const Program& f, const Segment& segment,
                                             std::span<const Uniform> uniforms, Expr s,
                                             Diagnostics& diagnostics);

}  // namespace imp
