// Addition chains: right, shortest where that is promised, and quick to find.
#include "ir/addition_chain.h"

#include <gtest/gtest.h>

#include <bit>
#include <set>
#include <vector>

#include "tests/support/random.h"

namespace imp {
namespace {

// All the powers that x^n is made of, but x itself.
void collect(std::uint32_t n, std::set<std::uint32_t>& powers) {
  if (n == 1 || !powers.insert(n).second) return;
  const auto [left, right] = split_power(n);
  EXPECT_EQ(left + right, n);
  EXPECT_GE(left, right);
  EXPECT_GE(right, 1u);
  collect(left, powers);
  collect(right, powers);
}

std::size_t products(std::uint32_t n) {
  std::set<std::uint32_t> powers;
  collect(n, powers);
  return powers.size();
}

std::size_t binary_products(std::uint32_t n) {
  return static_cast<std::size_t>(std::bit_width(n)) + static_cast<std::size_t>(std::popcount(n)) - 2;
}

// Whether `chain`, which ends in its largest number, can be made to end in n by `steps` more sums with the
// last number: below 12509 there is a shortest chain of that kind.
bool reaches(std::vector<std::uint32_t>& chain, std::uint32_t n, std::size_t steps) {
  const std::uint32_t last = chain.back();
  if (last == n) return true;
  if (steps == 0 || last << steps < n) return false;
  for (std::size_t i = chain.size(); i-- > 0;) {
    if (last + chain[i] > n) continue;
    chain.push_back(last + chain[i]);
    const bool found = reaches(chain, n, steps - 1);
    chain.pop_back();
    if (found) return true;
  }
  return false;
}

std::size_t shortest(std::uint32_t n) {
  std::vector<std::uint32_t> chain{1};
  std::size_t steps = 0;
  while (!reaches(chain, n, steps)) ++steps;
  return steps;
}

TEST(AdditionChain, is_shortest_up_to_128) {
  EXPECT_EQ(shortest(15), 5u);
  EXPECT_EQ(shortest(127), 10u);
  for (std::uint32_t n = 1; n <= 128; ++n) EXPECT_EQ(products(n), shortest(n)) << n;
}

TEST(AdditionChain, is_no_longer_than_squaring) {
  for (std::uint32_t n = 2; n <= 20000; ++n) ASSERT_LE(products(n), binary_products(n)) << n;
  test::Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const auto n = static_cast<std::uint32_t>(2 + random.below(0x7fffffff));
    ASSERT_LE(products(n), binary_products(n)) << n;
  }
  EXPECT_EQ(products(0x80000000), 31u);
  EXPECT_LT(products(0x7fffffff), 50u);
}

TEST(AdditionChain, powers_of_two_are_squares) {
  for (std::uint32_t n = 2; n != 0; n *= 2) EXPECT_EQ(split_power(n).left, n / 2);
}

TEST(AdditionChain, a_power_is_the_sum_of_its_factors) {
  for (const std::uint32_t n : {1u, 2u, 3u, 15u, 77u, 128u, 129u, 500u, 1048575u, 0x7fffffffu}) {
    int calls = 0;
    const auto sum = [&](std::uint64_t a, std::uint64_t b) { return ++calls, a + b; };
    EXPECT_EQ(positive_power(std::uint64_t{3}, n, sum), 3ull * n);
    EXPECT_LE(calls, 200) << n;
  }
}

}  // namespace
}  // namespace imp
