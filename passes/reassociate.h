// Reassociation: a sum of many terms is a long chain of ops of which each waits for the one before; as a tree
// they run beside each other.
#pragma once

#include "ir/program.h"

namespace imp {

// Sums and products of plain ops as balanced trees, and first what changes less often (constants, uniforms), so
// that it is computed less often. What has further users is not taken apart, a chain that is as short as it
// can be stays as it is. Preserves the real value. Not for a Program in which the order of roundings matters.
Program reassociate(const Program& program);

}  // namespace imp
