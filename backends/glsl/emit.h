// A Program as text in GLSL 4.50: a compute shader, meant to be read.
#pragma once

#include <expected>
#include <string>

#include "backends/kernel.h"

namespace imp {

// One invocation a ray, in work groups of that size; the buffers are in backends/glsl/layout.h.
inline constexpr std::uint32_t group_size = 64;

// Refuses what has no spelling, and what a driver would not compile in reasonable time or run to its end
// (docs/decisions/glsl.md).
std::expected<std::string, Refusal> emit_glsl(const Program& program);

}  // namespace imp
