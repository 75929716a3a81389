// imp trace: the steps of the search for a pixel, and that it answers what the picture shows.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/command.h"
#include "tests/support/golden.h"
#include "tests/support/image.h"

namespace imp {
namespace {

using test::CommandAnswer;
using test::expect_usage_error;
using test::Folder;

const std::string ball_of_r =
    "param r = 1.5\n"
    "surface ball: x^2 + y^2 + z^2 = r^2\n"
    "domain sphere(radius: 2)\n"
    "camera from (0, 0, 5) to (0, 0, 0) height 4.5\n";

CommandAnswer trace(const std::string& pixel, std::vector<std::string> more = {},
                    const std::string& text = ball_of_r) {
  std::vector<std::string> words{"trace", "-", "--size=16x16", "--pixel", pixel};
  words.insert(words.end(), more.begin(), more.end());
  return test::imp(words, text);
}

// The words behind a label at the beginning of a line.
std::string after(const std::string& text, const std::string& label) {
  const std::size_t at = text.find("\n" + label + " ");
  if (at == std::string::npos) return {};
  const std::size_t begin = text.find_first_not_of(' ', at + 1 + label.size());
  return text.substr(begin, text.find('\n', begin) - begin);
}

TEST(TraceGolden, shows_every_step) {
  const CommandAnswer answer = trace("7,8", {"--epsilon=2^-8", "--search=isolate"});
  EXPECT_EQ(answer.exit, 0);
  EXPECT_EQ(answer.err, "");
  test::expect_golden("trace.txt", answer.out);
}

// The same verdict, t, normal and number of steps as in the picture, bit for bit.
TEST(Trace, answers_what_the_picture_shows) {
  const Folder folder;
  for (const std::string& text : {ball_of_r, std::string("surface a: x^2 + y^2 = z^2\nsurface b: z = 0.5\n")})
    for (const std::string precision : {"float", "double"}) {
      const std::string picture = folder / "s.exr";
      ASSERT_EQ(test::imp({"render", "-", "--size=16x16", "-o", picture, "--aov=depth,normal,steps,verdict",
                           "--precision", precision, "--search=isolate", "--tiles=off"},
                          text)
                    .exit,
                0);
      const auto image = test::decode_image(picture);
      for (std::size_t i = 0; i < 16; ++i) {
        const std::size_t x = (5 * i) % 16, y = i;
        const CommandAnswer answer = trace(std::to_string(x) + "," + std::to_string(y),
                                           {"--precision", precision, "--search=isolate"}, text);
        ASSERT_EQ(answer.exit, 0) << answer.err;
        SCOPED_TRACE(answer.out);
        const float verdict = image.at(x, y, "verdict");
        EXPECT_TRUE(after(answer.out, "verdict")
                        .starts_with(verdict > 0    ? "hit"
                                     : verdict == 0 ? "miss"
                                                    : "undecided"));
        EXPECT_EQ(std::stof(after(answer.out, "steps")), image.at(x, y, "steps"));
        const float depth = image.at(x, y, "depth.Z");
        const std::string t = after(answer.out, "t"), normal = after(answer.out, "normal");
        EXPECT_EQ(t.empty(), !std::isfinite(depth));
        if (t.empty()) continue;
        EXPECT_EQ(std::stof(t), depth);
        EXPECT_EQ(std::stof(normal.substr(1)), image.at(x, y, "normal.X"));
      }
    }
}

TEST(Trace, says_why_a_ray_misses) {
  EXPECT_EQ(after(trace("0,0").out, "verdict"), "miss: the ray does not meet the domain");
  const CommandAnswer beside = trace("8,1");
  EXPECT_EQ(after(beside.out, "verdict"), "miss: every piece is excluded, certified");
  EXPECT_NE(beside.out.find("\nrefine: not entered\n"), std::string::npos);
  EXPECT_EQ(after(trace("8,1", {"-D", "r=1.9"}).out, "verdict"), "hit: the first root, certified");
}

TEST(Trace, reports_on_request) {
  const CommandAnswer answer = trace("7,8", {"--stats", "--timings", "--backend=llvm"});
  EXPECT_TRUE(answer.err.starts_with("1 pixels in ")) << answer.err;
  EXPECT_NE(answer.err.find("1 hit, 0 miss, 0 undecided"), std::string::npos);
  EXPECT_NE(answer.err.find("backend interpreter"), std::string::npos);
  EXPECT_NE(answer.err.find("\ntrace "), std::string::npos);
}

TEST(Trace, wants_a_pixel_of_the_picture) {
  expect_usage_error(test::imp({"trace", "-"}, ball_of_r), "--pixel is required");
  expect_usage_error(trace("16,0"), "--pixel: 16,0 is not in a picture of 16x16");
  expect_usage_error(trace("0,16"), "--pixel: 0,16 is not in a picture of 16x16");
  expect_usage_error(trace("7"), "--pixel: '7' is not of the form X,Y");
  expect_usage_error(trace("7,y"), "--pixel: 'y' is no whole number");
  EXPECT_EQ(trace("15,15").exit, 0);
  EXPECT_EQ(trace("7,7", {}, "x + = 1").exit, 1);
}

}  // namespace
}  // namespace imp
