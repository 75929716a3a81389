// For tests of shaders: a kernel, or the reason why there is no OpenGL here.
#pragma once

#include <gtest/gtest.h>

#include "backends/glsl/context.h"
#include "backends/glsl/kernel.h"

// In a test: ends it, skipped, where there is no OpenGL.
#define IMP_NEEDS_GL() \
  if (const auto gl = ::imp::GlContext::get(); !gl) GTEST_SKIP() << gl.error()

namespace imp::test {

inline std::unique_ptr<Kernel> shader_of(const Program& program) {
  auto kernel = compile_glsl(program);
  EXPECT_TRUE(kernel.has_value()) << kernel.error().message;
  return kernel.has_value() ? *std::move(kernel) : nullptr;
}

}  // namespace imp::test
