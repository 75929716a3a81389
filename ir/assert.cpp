#include "ir/assert.h"

#include <cstdio>
#include <cstdlib>

namespace imp {

void assertion_failed(const char* condition, const char* expectation, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: internal error: expected %s (%s)\n", file, line, expectation, condition);
  std::abort();
}

}  // namespace imp
