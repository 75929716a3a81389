// The functions that ops are spelled with, written in GLSL: add_up, exponent, scale2 and their like.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ir/type.h"

namespace imp {

// A function by name and by the type of its numbers.
using Helpers = std::set<std::pair<std::string_view, Scalar>>;

// Those that are called in `spelling`, a text as in the column `glsl` of ir/ops.def.
std::vector<std::string_view> helpers_in(std::string_view spelling);

std::vector<std::string_view> helper_names();

// The text of `used` and of all that they call. What they promise is in the column `meaning` of
// ir/ops.def; an upward result may lie above the least one:
//
//   It is the nearest number r, to which |r| u (1 + 2u) + 2^-126 is added, u = 2^-24 (double: 2^-53 and
//   2^-1022). That is the number after r (Rump, Zimmermann, Boldo, Melquiond 2009: Computing predecessor
//   and successor in rounding to nearest), and near zero what a driver loses that flushes denormal results.
//   A result below zero is not raised above it, an exact zero stays, and one that overflowed to -inf is
//   the least finite number.
//
// None looks at the sign of a zero, which a driver need not keep, or gives a denormal, which a driver may take
// for zero. A quotient by zero is infinite upward, and a product with zero is zero, with infinity too.
//
// They expect the uniforms `zero` and `zero_f64`: Mesa folds x * 0 and x + 0, whatever x is, where it sees
// the 0, in spite of `precise`.
std::string prelude(const Helpers& used);

}  // namespace imp
