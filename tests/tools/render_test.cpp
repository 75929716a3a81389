// imp render: what is in the picture, and that the file appears whole or not at all.
#include <csignal>

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include "tests/support/command.h"
#include "tests/support/image.h"

namespace imp {
namespace {

using test::CommandAnswer;
using test::Folder;

const std::string ball =
    "surface ball: x^2 + y^2 + z^2 = 2.25\n"
    "domain box((-2, -2, -2), (2, 2, 2))\n"
    "camera from (0, 0, 5) to (0, 0, 0) height 4\n";

const char* const ball_picture = R"(
................
................
......####......
....########....
...##########...
...##########...
..############..
..############..
..############..
..############..
...##########...
...##########...
....########....
......####......
................
................
)";

// Verdicts: # hit, . miss, ? undecided.
std::string picture_of(const test::DecodedImage& image) {
  std::string text = "\n";
  for (std::size_t y = 0; y < image.height; ++y) {
    for (std::size_t x = 0; x < image.width; ++x) {
      const float verdict = image.at(x, y, "verdict");
      text += verdict == 1 ? '#' : verdict == 0 ? '.' : '?';
    }
    text += '\n';
  }
  return text;
}

TEST(Render, refuses_places_whose_squares_are_no_floats) {
  const Folder folder;
  const CommandAnswer answer = test::imp({"render", "-", "-o", folder / "s.png", "--size=8x8"},
                                         "x = y\ndomain sphere(radius: 2e18)\n");
  EXPECT_EQ(answer.exit, 1);
  EXPECT_NE(answer.err.find("2:23: error: in a picture no radius is beyond 1e18"), std::string::npos)
      << answer.err;
}

TEST(Render, economises_over_a_known_domain) {
  const Folder folder;
  const std::string f = "param p = 2\nx + x^12/1e12 = y\ndomain box((-p, -2, -2), (2, 2, 2))\n";
  const std::string option = "--economize=1e-6";
  EXPECT_EQ(test::imp({"render", "-", "-o", folder / "s.png", "--size=8x8", option}, ball).exit, 0);
  const CommandAnswer unknown = test::imp({"render", "-", "-o", folder / "t.png", "--size=8x8", option}, f);
  EXPECT_EQ(unknown.exit, 1);
  EXPECT_NE(unknown.err.find("--economize needs a domain that does not depend on parameters or time"),
            std::string::npos);
  for (const std::string wrong : {"0", "-1", "inf", "nan"})
    test::expect_usage_error(test::imp({"render", "-", "--economize=" + wrong}, ball),
                             "--economize: '" + wrong + "' is not above 0 and finite");
}

TEST(Render, draws_a_ball) {
  const Folder folder;
  const CommandAnswer answer =
      test::imp({"render", folder.write("s.imp", ball), "--size", "16x16", "-o", folder / "s.exr",
                 "--aov=depth,normal,steps,verdict", "--stats=json"});
  ASSERT_EQ(answer.exit, 0) << answer.err;
  const auto image = test::decode_image(folder / "s.exr");
  EXPECT_EQ(picture_of(image), ball_picture);
  EXPECT_NEAR(image.at(8, 8, "depth.Z"), 3.5, 0.05);
  EXPECT_NEAR(image.at(8, 8, "normal.Z"), 1, 0.02);
  EXPECT_GT(image.at(8, 8, "steps"), 0);
  EXPECT_GT(image.at(8, 8, "R"), 0);

  const auto stats = nlohmann::json::parse(answer.err);
  EXPECT_EQ(stats["pixels"], 256);
  EXPECT_EQ(stats["hit"], std::ranges::count(std::string(ball_picture), '#'));
  EXPECT_EQ(stats["undecided"], 0);
  EXPECT_GT(stats["steps"]["max"], 0);
}

TEST(Render, threads_change_no_bit) {
  const Folder folder;
  const std::string file = folder.write("s.imp", ball);
  for (const std::string threads : {"1", "4"})
    for (const std::string ending : {".png", ".exr"})
      ASSERT_EQ(test::imp({"render", file, "--size=200x150", "--threads", threads, "-o",
                           folder / (threads + ending)})
                    .exit,
                0);
  EXPECT_TRUE(test::read_file(folder / "1.png") == test::read_file(folder / "4.png"));
  EXPECT_TRUE(test::read_file(folder / "1.exr") == test::read_file(folder / "4.exr"));
}

TEST(Render, names_the_picture_after_the_file) {
  const Folder folder, other;
  ASSERT_EQ(test::imp({"render", folder.write("ball.imp", ball), "--size=8x8"}, {}, other / ".").exit, 0);
  EXPECT_EQ(other.names(), std::vector<std::string>{"ball.png"});
}

TEST(Render, reads_and_writes_standard_streams) {
  const CommandAnswer answer = test::imp({"render", "-", "--size=8x8", "-o", "-"}, ball);
  EXPECT_EQ(answer.exit, 0);
  EXPECT_EQ(answer.err, "");
  EXPECT_TRUE(answer.out.starts_with("\x89PNG"));
}

TEST(Render, times_its_frames) {
  const Folder folder;
  const CommandAnswer answer =
      test::imp({"render", "-", "--size=8x8", "-o", folder / "a.png", "--repeat=3", "--timings"}, ball);
  EXPECT_TRUE(answer.err.starts_with("3 frames: ")) << answer.err;
  for (const char* stage : {"parse", "passes", "render", "image"})
    EXPECT_NE(answer.err.find(std::string("\n") + stage), std::string::npos) << answer.err;
}

TEST(Render, leaves_nothing_where_it_cannot_write) {
  const Folder folder;
  const CommandAnswer missing = test::imp({"render", "-", "-o", folder / "no/a.png"}, ball);
  EXPECT_EQ(missing.exit, 1);
  EXPECT_EQ(missing.err, "error: cannot write '" + (folder / "no/a.png") + "': No such file or directory\n");

  std::filesystem::create_directories(folder / "b.png/inside");
  const CommandAnswer taken = test::imp({"render", "-", "--size=8x8", "-o", folder / "b.png"}, ball);
  EXPECT_EQ(taken.exit, 1);
  EXPECT_EQ(taken.err, "error: cannot write '" + (folder / "b.png") + "': Is a directory\n");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"b.png"});

  EXPECT_EQ(test::imp({"render", "-", "-o", "/proc/a.png", "--size=8x8"}, ball).exit, 1);
}

TEST(Render, leaves_the_old_picture_where_the_file_is_wrong) {
  const Folder folder;
  const std::string old = folder.write("a.png", "old");
  EXPECT_EQ(test::imp({"render", "-", "-o", old}, "x + = 1").exit, 1);
  EXPECT_EQ(test::read_file(old), "old");
}

TEST(Render, interrupts_leave_nothing) {
  const Folder folder;
  const std::string file = folder.write("s.imp", ball), picture = folder / "a.png";
  const std::vector<std::string> words{"render", file, "-o", picture, "--repeat=1000000"};
  // A shell ends it: `imp` waits for its children and has no time limit.
  std::string command = std::string("timeout -s INT 1 ") + IMP_COMMAND;
  for (const std::string& word : words) command += " " + word;
  const int status = std::system((command + " 2>/dev/null").c_str());
  EXPECT_EQ(WEXITSTATUS(status), 124);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"s.imp"});
}

}  // namespace
}  // namespace imp
