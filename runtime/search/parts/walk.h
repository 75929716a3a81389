// Walking along a ray on which f is a polynomial, by the signs of its Bernstein coefficients.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "runtime/search/search.h"

namespace imp {

// From the coefficients over the whole segment, places to split it at, ascending; values at points only.
using Proposals = std::function<std::vector<Expr>(std::span<const Interval> coefficients)>;

// Appends the search. The coefficients are of the kernel's type up to degree 6, and in double above. Errors where f
// is no polynomial, or of too high a degree.
std::optional<Found> walk(Program& program, const RayFunction& f, const SearchLimits& limits,
                          Diagnostics& diagnostics, const Proposals& proposals = {});

}  // namespace imp
