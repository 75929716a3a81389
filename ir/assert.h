// Our own mistakes. A failed assertion is a bug in imp, never the user's fault.
#pragma once

namespace imp {

[[noreturn]] void assertion_failed(const char* condition, const char* expectation, const char* file,
                                   int line);

}  // namespace imp

#define IMP_ASSERT(condition, expectation) \
  ((condition) ? void(0) : ::imp::assertion_failed(#condition, expectation, __FILE__, __LINE__))
