#include "bench/by_hand.h"

#include <algorithm>

namespace imp::bench {
namespace {

constexpr ByHand rows[] = {
    {"sphere", {34, 30, 14, 9.1, 5.7}, {0.21, 0.8, 1.2, 1.3, 1.7, 2.8}},
    {"steiner", {66, 42, 40, 12, 7.7}, {0.40, 2.0, 3.2, 3.8, 7.0, 8.1}},
    {"mitchell", {143, 46, 35, 14, 8.6}, {0.55, 2.2, 2.9, 3.4, 5.0, 8.0}},
    {"tangle", {51, 41, 25, 11, 6.8}, {0.48, 1.6, 3.0, 3.3, 4.7, 6.7}},
    {"barth_sextic", {123, 66, 78, 17, 11.6}, {0.78, 3.8, 4.3, 5.2, 6.2, 7.8}},
    {"barth_decic", {517, 151, 203, 66, 53}, {0.97, 5.0, 7.4, 8.2, 13.5, 17}},
    {"decocube", {96, 106, 133, 30, 21}, {0.88, 3.2, 5.2, 6.1, 9.2, 12}},
    {"superquadric_knoll", {49, 0, 0, 0, 23}, {1.3, 2.5, 3.4, 4.7, 6.1, 7.8}},
    {"sin_blob", {676, 342, 366, 0, 58}, {12, 24, 42, 25, 34, 70}},
    {"water", {183, 267, 69, 0, 21}, {5.9, 12, 16, 31, 37, 42}},
    {"blinn_gauss", {97, 125, 107, 0, 11.7}, {6.5, 12, 16, 32, 37, 24}},
};

}  // namespace

std::span<const ByHand> by_hand() { return rows; }

const ByHand* by_hand(std::string_view surface) {
  const auto* it = std::ranges::find(rows, surface, &ByHand::surface);
  return it == std::end(rows) ? nullptr : it;
}

}  // namespace imp::bench
