#include "ir/addition_chain.h"

#include <array>

#include "ir/assert.h"

namespace imp {
namespace {

// The larger summand of n, from n = 2 on, found by simulated annealing: for the fewest products first,
// then for squares, the more so the smaller n is.
constexpr std::array<std::uint8_t, 127> larger_summand{
    1,  2,   2,   3,  3,   6,  4,  8,   5,  9,   6,  12, 7,  12,  8,  9,   9,  18,  10, 17, 18,  20,
    12, 16,  13,  18, 14,  28, 24, 30,  16, 32,  17, 33, 18, 36,  36, 26,  20, 33,  30, 40, 36,  36,
    23, 38,  24,  33, 25,  48, 26, 49,  48, 54,  28, 49, 52, 50,  48, 48,  31, 36,  32, 64, 33,  64,
    34, 65,  66,  67, 36,  64, 66, 51,  38, 68,  54, 77, 64, 65,  41, 43,  42, 68,  43, 86, 44,  81,
    45, 72,  46,  62, 72,  92, 48, 96,  96, 96,  50, 66, 51, 97,  52, 104, 88, 104, 72, 97, 104, 60,
    56, 112, 102, 66, 100, 72, 59, 112, 96, 120, 98, 99, 88, 100, 90, 96,  64,
};

constexpr std::uint32_t largest_in_table = 1 + larger_summand.size();

}  // namespace

PowerSplit split_power(std::uint32_t n) {
  IMP_ASSERT(n >= 2, "a power that is a product");
  std::uint32_t left = n / 2;
  if (n <= largest_in_table)
    left = larger_summand[n - 2];
  else if (n % 2 == 1)
    left = n - n % 4;  // so that squares make it; x^1 and x^3 are there, or cost little
  return {left, n - left};
}

}  // namespace imp
