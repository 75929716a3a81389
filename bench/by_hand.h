// What hand-written kernels took, with AVX-512, to nearest and with denormals flushed, on one thread of
// 223 GFLOP/s: frames of 1024 x 1024, and single evaluations.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

namespace imp::bench {

constexpr double by_hand_gflops = 223;

// Ways to draw a frame; "tiles" is the best of them behind affine forms over beams of 64, 16 and 8 pixels.
enum class Way : std::uint8_t { bisection, affine_bisection, isolate, bernstein, tiles };

enum class Evaluation : std::uint8_t { value, gradient, interval, affine_1, affine_3, with_slope };

// 0: not measured.
struct ByHand {
  std::string_view surface;
  std::array<double, 5> frames;  // milliseconds, in the order of Way
  std::array<double, 6> cycles;  // a lane of 16, in the order of Evaluation

  double frame(Way way) const { return frames[static_cast<std::size_t>(way)]; }
  double evaluation(Evaluation each) const { return cycles[static_cast<std::size_t>(each)]; }
};

std::span<const ByHand> by_hand();
const ByHand* by_hand(std::string_view surface);  // null: not written

}  // namespace imp::bench
