// What of a Program no shader is made of, and why.
#pragma once

#include <optional>

#include "backends/kernel.h"

namespace imp {

std::optional<Refusal> glsl_refusal(const Program& program);

}  // namespace imp
