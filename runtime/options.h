// How a kernel is to be made.
#pragma once

#include <string>

#include "ir/type.h"

namespace imp {

enum class Backend : std::uint8_t { llvm, interpreter, glsl };

struct KernelOptions {
  Backend backend = Backend::llvm;
  std::string target = "host";  // of the llvm backend
  Type precision = f32;
  bool outward = true;  // false: enclosures round to nearest, as in the papers
};

}  // namespace imp
