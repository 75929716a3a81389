// Image files: they read back as they were, and appear whole or not at all.
#include "runtime/image.h"

#include <sys/stat.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include <gtest/gtest.h>

#include "tests/support/command.h"
#include "tests/support/image.h"

namespace imp {
namespace {

using test::Folder;

// Two pixels a row; the values of a channel lie `stride` apart.
struct Sample {
  std::vector<float> color{0, 0.5f, 1, 0.0031308f, 0.2140411f, 0.0002f, NAN, -1, 7, 0.25f, 0.75f, 0.001f};
  std::vector<float> depth{1.5f, std::numeric_limits<float>::infinity(), -0.0f, 1e-30f};

  Image image(bool with_depth) const {
    Image result{2, 2, {}};
    for (std::size_t c = 0; c < 3; ++c)
      result.channels.push_back({std::string(1, "RGB"[c]), std::span(color).subspan(c), 3});
    if (with_depth) result.channels.push_back({"depth.Z", depth, 1});
    return result;
  }
};

// IEC 61966-2-1, in double.
int srgb(double linear) {
  if (!(linear > 0)) return 0;
  if (linear >= 1) return 255;
  return static_cast<int>(
      255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055) + 0.5);
}

TEST(Image, exr_keeps_every_bit) {
  const Folder folder;
  const Sample sample;
  ASSERT_EQ(write_image(folder / "a.exr", sample.image(true)), std::nullopt);
  const auto read = test::decode_image(folder / "a.exr");
  ASSERT_EQ(read.width, 2u);
  ASSERT_EQ(read.height, 2u);
  ASSERT_EQ(read.names.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(read.at(i % 2, i / 2, "depth.Z"), sample.depth[i]);
    EXPECT_EQ(std::signbit(read.at(i % 2, i / 2, "depth.Z")), std::signbit(sample.depth[i]));
    for (std::size_t c = 0; c < 3; ++c) {
      const float wrote = sample.color[3 * i + c], got = read.at(i % 2, i / 2, std::string(1, "RGB"[c]));
      EXPECT_TRUE(got == wrote || (std::isnan(got) && std::isnan(wrote))) << got << " is not " << wrote;
    }
  }
}

TEST(Image, png_is_srgb) {
  const Folder folder;
  std::vector<float> gray;
  for (int i = 0; i < 4096; ++i) gray.push_back(static_cast<float>(i) / 4095);
  Image image{64, 64, {}};
  for (const char* name : {"R", "G", "B"}) image.channels.push_back({name, gray, 1});
  ASSERT_EQ(write_image(folder / "a.png", image), std::nullopt);
  const auto read = test::decode_image(folder / "a.png");
  for (std::size_t i = 0; i < gray.size(); ++i)
    ASSERT_EQ(read.at(i % 64, i / 64, "G"), srgb(gray[i])) << gray[i];

  const Sample sample;
  ASSERT_EQ(write_image(folder / "b.png", sample.image(false)), std::nullopt);
  const auto colors = test::decode_image(folder / "b.png");
  for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(colors.values[i], srgb(sample.color[i])) << sample.color[i];
}

TEST(Image, equal_pictures_are_equal_files) {
  const Folder folder;
  for (const std::string name : {"a", "b"}) {
    if (name == "b") std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // no date is in them
    for (const std::string ending : {".png", ".exr"})
      ASSERT_EQ(write_image(folder / (name + ending), Sample().image(ending == ".exr")), std::nullopt);
  }
  EXPECT_TRUE(test::read_file(folder / "a.png") == test::read_file(folder / "b.png"));
  EXPECT_TRUE(test::read_file(folder / "a.exr") == test::read_file(folder / "b.exr"));
}

TEST(Image, refuses_what_the_format_cannot_hold) {
  const Folder folder;
  EXPECT_NE(write_image(folder / "a.png", Sample().image(true)), std::nullopt);
  EXPECT_NE(write_image(folder / "a.jpg", Sample().image(false)), std::nullopt);
  EXPECT_TRUE(folder.names().empty());
}

TEST(Image, replaces_a_file_whole_and_leaves_nothing_else) {
  const Folder folder;
  folder.write("a.png", "old");
  ASSERT_EQ(write_image(folder / "a.png", Sample().image(false)), std::nullopt);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.png"});
  EXPECT_TRUE(test::read_file(folder / "a.png").starts_with("\x89PNG"));

  struct stat status{};
  stat((folder / "a.png").c_str(), &status);
  const mode_t mask = umask(0);
  umask(mask);
  EXPECT_EQ(status.st_mode & 0777u, 0666u & ~mask);
}

TEST(Image, leaves_nothing_where_it_fails) {
  const Folder folder;
  std::filesystem::create_directories(folder / "a.png/inside");
  const auto problem = write_image(folder / "a.png", Sample().image(false));
  ASSERT_TRUE(problem);
  EXPECT_EQ(*problem, "cannot write '" + (folder / "a.png") + "': Is a directory");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.png"});

  EXPECT_EQ(write_image(folder / "no/a.png", Sample().image(false)),
            "cannot write '" + (folder / "no/a.png") + "': No such file or directory");
}

TEST(Image, a_link_stays_a_link) {
  const Folder folder;
  folder.write("real.png", "old");
  std::filesystem::create_symlink("real.png", folder / "a.png");
  ASSERT_EQ(write_image(folder / "a.png", Sample().image(false)), std::nullopt);
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "a.png"));
  EXPECT_TRUE(test::read_file(folder / "real.png").starts_with("\x89PNG"));
}

}  // namespace
}  // namespace imp
