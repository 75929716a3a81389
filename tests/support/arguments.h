// Arguments to try functions at, by number: all floats in the order of their bits, and numbers that
// lie where functions turn.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "ir/infinity.h"
#include "ir/type.h"

namespace imp::test {

inline double float_of_bits(std::uint32_t bits) { return std::bit_cast<float>(bits); }

// 0, ±1, halves and multiples of pi, powers of two, ends of the range, each with its neighbours.
inline std::vector<double> special_arguments(Type type) {
  std::vector<double> centers{0,      1,     0.5, 2, 1e-3, 10, 100, 0x1.62e42fefa39efp6, 0x1.62e42fefa39efp9,
                              103.97, 745.13};
  for (int k = 1; k <= 64; ++k) centers.push_back(k * 0.78539816339744831);
  for (int k = 100; k < 40'000; k = k * 5 / 3 + 1) centers.push_back(k * 0.78539816339744831);
  for (int e = type == f32 ? -149 : -1074; e <= (type == f32 ? 127 : 1023); e += type == f32 ? 1 : 7)
    centers.push_back(std::ldexp(1.0, e));
  std::vector<double> all;
  for (const double center : centers)
    for (const double sign : {1.0, -1.0}) {
      double x = type == f32 ? static_cast<double>(static_cast<float>(sign * center)) : sign * center;
      for (int step = 0; step < 3; ++step) {
        all.push_back(x);
        x = type == f32 ? std::nextafterf(static_cast<float>(x), 0.0f) : std::nextafter(x, 0.0);
      }
      x = type == f32
              ? std::nextafterf(static_cast<float>(sign * center), static_cast<float>(sign * infinity))
              : std::nextafter(sign * center, sign * infinity);
      all.push_back(x);
    }
  for (const double x : {infinity, -infinity, std::numeric_limits<double>::quiet_NaN()}) all.push_back(x);
  const double end = type == f32 ? std::numeric_limits<float>::max() : std::numeric_limits<double>::max();
  all.insert(all.end(), {end, -end});
  return all;
}

inline double rounded(long double x, Type type) {
  return type == f32 ? static_cast<double>(static_cast<float>(x)) : static_cast<double>(x);
}

// A number that is 1 in this type's digits but for the last few, or but for all.
inline double random_near_one(std::mt19937_64& random, Type type) {
  const std::uint64_t digits = type == f32 ? 24 : 53;
  std::uniform_real_distribution<double> unit(-1, 1);
  return rounded(1 + unit(random) * std::ldexp(1.0, -static_cast<int>(random() % digits)), type);
}

// A number of this type: one time in four near 1 or -1, one in eight next to a multiple of pi/2, one in
// eight of moderate size, else of any bits.
inline double random_argument(std::mt19937_64& random, Type type) {
  std::uniform_real_distribution<double> unit(-1, 1);
  switch (random() % 8) {
    case 0: return random_near_one(random, type);
    case 1: return -random_near_one(random, type);
    case 2: {
      const std::uint64_t turns = random() >> (34 + random() % 29);
      return rounded(static_cast<long double>(turns) * std::numbers::pi_v<long double> / 2, type);
    }
    case 3:  return rounded(unit(random) * std::ldexp(1.0, static_cast<int>(random() % 20) - 8), type);
    default: break;
  }
  return type == f32 ? float_of_bits(static_cast<std::uint32_t>(random())) : std::bit_cast<double>(random());
}

// One to go with `x`: one time in four as large but for a factor near 1.
inline double random_argument_beside(double x, std::mt19937_64& random, Type type) {
  return random() % 4 == 0 ? rounded(x * random_near_one(random, type), type) : random_argument(random, type);
}

}  // namespace imp::test
