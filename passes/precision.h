// Precision: from the mathematics (f64, constants unresolved) to a Program that a backend runs.
#pragma once

#include "ir/program.h"

namespace imp {

// `program` (all f64) with its numbers of type `type`, and each constant sub-expression replaced
// by the nearest number of that type.
Program in_precision(const Program& program, Type type);

}  // namespace imp
