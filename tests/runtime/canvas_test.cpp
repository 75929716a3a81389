// A Canvas: what of a Program's outputs lands where in a picture.
#include "runtime/canvas.h"

#include <gtest/gtest.h>

#include <cmath>

#include "runtime/render.h"

namespace imp {
namespace {

// Two pixels inside of 2 x 2, and one on either side out of it.
const std::vector<std::uint32_t> columns{0, 1, 2, 0}, rows{0, 1, 0, 2};

std::vector<Output> outputs(std::vector<std::string> names) {
  std::vector<Output> result;
  for (std::string& name : names) result.push_back({std::move(name), {}});
  return result;
}

Picture two_by_two() {
  Picture picture;
  picture.width = picture.height = 2;
  return picture;
}

TEST(Canvas, draws_what_lies_in_the_picture) {
  Picture picture = two_by_two();
  Canvas canvas(picture, outputs({"green", "verdict"}));
  const std::vector<std::vector<float>> values{{0.25F, 0.5F, 9, 9}, {1, 0, 9, 9}};
  canvas.draw({4, columns, rows, values});
  EXPECT_EQ(picture.color[1], 0.25F);
  EXPECT_EQ(picture.color[10], 0.5F);
  EXPECT_EQ(picture.verdict, (std::vector<float>{1, 0, 0, 0}));
  EXPECT_TRUE(canvas.undecided().columns.empty());
}

TEST(Canvas, clears_to_the_background) {
  Picture picture = two_by_two();
  Canvas canvas(picture, outputs({"verdict", "depth"}));
  picture.verdict = {7, 7, 7, 7};
  canvas.clear(1, 0, 1, 2);
  EXPECT_EQ(picture.verdict, (std::vector<float>{7, 0, 7, 0}));
  EXPECT_EQ(picture.depth, (std::vector<float>{0, INFINITY, 0, INFINITY}));
}

TEST(Canvas, keeps_what_a_second_look_leaves_undecided) {
  Picture picture = two_by_two();
  Canvas canvas(picture, outputs({"verdict", "depth", "steps"}));
  canvas.draw(
      {4, columns, rows, std::vector<std::vector<float>>{{-1, -1, 0, 0}, {3, 4, 0, 0}, {5, 6, 0, 0}}});
  const Undecided open = canvas.undecided();
  EXPECT_EQ(open.columns, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(open.rows, (std::vector<std::uint32_t>{0, 1}));
  canvas.draw_decided(
      {2, open.columns, open.rows, std::vector<std::vector<float>>{{1, -1}, {3.5F, 9}, {10, 20}}});
  EXPECT_EQ(picture.verdict, (std::vector<float>{1, 0, 0, -1}));
  EXPECT_EQ(picture.depth, (std::vector<float>{3.5F, 0, 0, 4}));
  EXPECT_EQ(picture.steps, (std::vector<float>{15, 0, 0, 26}));
}

TEST(Canvas, leaves_nothing_of_what_a_used_picture_held) {
  Picture picture = two_by_two();
  picture.normal = picture.depth = {1, 2, 3};
  const Canvas canvas(picture, outputs({"verdict", "depth"}));
  EXPECT_TRUE(picture.normal.empty());
  EXPECT_EQ(picture.depth.size(), 4U);
}

}  // namespace
}  // namespace imp
