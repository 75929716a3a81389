// The infinity of double, which rounds to that of float.
#pragma once

#include <limits>

namespace imp {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace imp
