// How much of a long test is run.
#pragma once

#include <cstddef>

namespace imp::test {

#ifdef IMP_SANITIZED
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

// Sanitizers look for faults of our code, which a tenth of the samples of our arithmetic runs through as well.
constexpr std::size_t effort(std::size_t count) { return sanitized ? (count + 9) / 10 : count; }

}  // namespace imp::test
