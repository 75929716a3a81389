// Constant sub-expressions (tau, sqrt(5), 0.1, 2^(1/3)), evaluated on the host in 160 bits (MPFI):
// an interval where an enclosure is built, the nearest number where a value is.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "ir/program.h"

namespace imp {

struct Enclosure {
  double lo, hi;   // lo > hi: empty, the expression has no value (sqrt(-1), 1/0)
  double nearest;  // NaN where empty
  float nearest_float;
  bool continuous;  // defined and continuous there (floor at an integer is not)
};

// For every node of the Program's constant region its value, by index; nothing for other nodes. Truths
// are 0 and 1, and [0, 1] where 160 bits do not decide. `nearest` then takes two numbers that may be equal
// to be equal, and what may be an integer for one: floor(sqrt(2)*sqrt(2)) is 2, in [1, 2].
std::vector<std::optional<Enclosure>> constant_values(const Program& program);

// The value of one op, at numbers.
Enclosure constant_value(Op op, std::span<const double> args);

}  // namespace imp
