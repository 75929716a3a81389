// Lowers the elementary functions to basic ops: after it no backend needs a math library.
#pragma once

#include "ir/program.h"

namespace imp {

// `program` with every op of the kind `elementary` spelled as in passes/elementary/functions.h.
Program lower_elementary(const Program& program);

}  // namespace imp
