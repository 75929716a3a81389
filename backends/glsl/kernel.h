// Kernels of GLSL: a Program as a compute shader, run without a window.
#pragma once

#include <expected>
#include <memory>

#include "backends/kernel.h"

namespace imp {

// Refuses what `emit_glsl` refuses, and where there is no OpenGL. Plain ops round to nearest, whatever
// else the Program holds, and an upward op is at or above its exact value (backends/glsl/prelude.h). One
// batch runs at a time, on all cores.
std::expected<std::unique_ptr<Kernel>, Refusal> compile_glsl(Program program);

}  // namespace imp
