// The floating-point state of a run: the rounding mode of the Program, denormals kept, no traps,
// whatever the caller had; the caller's state is back afterwards.
#pragma once

#include <cfenv>

#ifdef __SSE2__
#include <immintrin.h>
#endif

namespace imp {

class FloatMode {
 public:
  explicit FloatMode(int rounding) {
    std::feholdexcept(&before_);
    std::fesetround(rounding);
#ifdef __SSE2__
    constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x0040;
    _mm_setcsr(_mm_getcsr() & ~(flush_to_zero | denormals_are_zero));
#endif
  }
  ~FloatMode() { std::fesetenv(&before_); }
  FloatMode(const FloatMode&) = delete;
  FloatMode& operator=(const FloatMode&) = delete;

 private:
  std::fenv_t before_;
};

}  // namespace imp
