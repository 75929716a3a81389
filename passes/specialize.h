// Formulas are often simpler over the domain that is looked at than everywhere.
#pragma once

#include <span>

#include "ir/program.h"
#include "passes/range.h"

namespace imp {

// `f` (f64, constants unresolved) over `domain`, a range for each input in order: abs, min, max and choices
// that are decided there are gone, and what has one value there is that constant. Preserves the real value
// within the domain, and where there is none; beyond it the result is another function.
Program specialize(const Program& f, std::span<const Range> domain);

}  // namespace imp
