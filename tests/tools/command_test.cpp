// The command as a whole: exit codes, help, and what is refused by name.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "passes/extend/inclusion.h"
#include "tests/support/command.h"

namespace imp {
namespace {

using test::CommandAnswer;
using test::Folder;

const std::string sphere = IMP_SOURCE_DIR "/examples/surfaces/sphere.imp";

// A usage error, whose message holds `message`.
void expect_misuse(const std::vector<std::string>& words, const std::string& message) {
  const CommandAnswer answer = test::imp(words);
  test::expect_usage_error(answer, "");
  EXPECT_NE(answer.err.find(message), std::string::npos) << answer.err << "does not hold: " << message;
}

TEST(Command, says_what_it_is) {
  EXPECT_EQ(test::imp({"--version"}).out.substr(0, 4), "imp ");
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{{"--help"},
                                                                                     {"render", "--help"},
                                                                                     {"eval", "-h"},
                                                                                     {"cast", "--help"},
                                                                                     {"check", "--help"},
                                                                                     {"inspect", "--help"},
                                                                                     {"trace", "--help"},
                                                                                     {"list", "--help"}}) {
    const CommandAnswer answer = test::imp(words);
    EXPECT_EQ(answer.exit, 0);
    EXPECT_EQ(answer.err, "");
    EXPECT_NE(answer.out.find("Usage: imp"), std::string::npos);
  }
}

TEST(Command, refuses_verbs_it_does_not_know) {
  expect_misuse({}, "a verb is missing");
  expect_misuse({"rendr", sphere}, "unknown verb 'rendr'; did you mean 'render'?");
  expect_misuse({"--size", "3x3"}, "a verb comes first");
  for (const std::string verb : {"compile", "bench", "view"})
    expect_misuse({verb, sphere}, "'" + verb + "' is not there yet");
}

TEST(Command, refuses_options_by_name) {
  expect_misuse({"render"}, "F.imp");
  expect_misuse({"render", sphere, "--sise", "3x3"}, "unexpected '--sise'; did you mean '--size'?");
  expect_misuse({"render", sphere, "other.imp"}, "unexpected 'other.imp'");
  expect_misuse({"render", sphere, "--backend", "lvm"}, "--backend: unknown 'lvm'; did you mean 'llvm'?");
  expect_misuse({"render", sphere, "--search=isolat"}, "unknown 'isolat'; did you mean 'isolate'?");
  expect_misuse({"render", sphere, "--inclusion=af9"}, "unknown 'af9'; did you mean 'af1'?");
  expect_misuse({"render", sphere, "--tiles=yes"}, "unknown 'yes'");
  expect_misuse({"render", sphere, "--target=arm"}, "--target: unknown 'arm'");
  expect_misuse({"eval", sphere, "--points", "-"}, "--program");
  expect_misuse({"eval", sphere, "--program", "f"}, "--points");
  expect_misuse({"cast", "-", "--rays", "-"}, "only one of two files");
  expect_misuse({"list", "colours"}, "unknown 'colours'");
}

TEST(Command, refuses_values_that_make_no_sense) {
  for (const std::string size : {"", "3", "0x3", "3x", "70000x1", "65536x65536", "3.5x3", "axb", "-3x3"})
    expect_misuse({"render", sphere, "--size", size}, "--size");
  for (const std::string epsilon : {"0", "-1", "2", "2^3", "x", "2^", "nan"})
    expect_misuse({"render", sphere, "--epsilon", epsilon}, "--epsilon");
  for (const std::string setting : {"r", "r=", "=3", "r=x"})
    expect_misuse({"render", sphere, "-D", setting}, "-D");
  expect_misuse({"render", sphere, "--time", "x"}, "--time");
  expect_misuse({"render", sphere, "--threads", "0"}, "--threads");
  expect_misuse({"render", sphere, "--repeat", "0"}, "--repeat");
  expect_misuse({"render", sphere, "--stats=xml"}, "--stats");
  expect_misuse({"render", sphere, "-o", "x.jpg"}, "neither .png nor .exr");
  expect_misuse({"render", sphere, "-o", "x.png", "--aov", "depth"}, ".exr holds");
  expect_misuse({"render", sphere, "-o", "x.exr", "--aov", "depth,color"}, "unknown 'color'");
}

TEST(Command, the_last_value_counts_and_both_forms_work) {
  const std::string point = "x,y,z\n0,0,0\n";
  const auto value = [&](std::vector<std::string> options) {
    std::vector<std::string> words{"eval", sphere, "--points", "-", "--program", "f"};
    words.insert(words.end(), options.begin(), options.end());
    return test::imp(words, point).out;
  };
  const std::string expected = "x,y,z,f\n0,0,0,-1\n";
  EXPECT_EQ(value({"--backend=llvm", "--backend", "interpreter"}), expected);
  EXPECT_EQ(value({"--backend", "nonsense", "--backend=llvm"}), expected);
  EXPECT_EQ(value({"-D", "r=0.5", "-Dr=1"}), expected);
  EXPECT_EQ(value({"--precision=double", "--rounding", "nearest", "--target=host", "--epsilon=2^-11"}),
            expected);
  EXPECT_EQ(value({"-D", "r=0.5"}), "x,y,z,f\n0,0,0,-0.25\n");
}

TEST(Command, names_what_it_cannot_read) {
  const CommandAnswer missing = test::imp({"render", "x.imp"});
  EXPECT_EQ(missing.exit, 1);
  EXPECT_EQ(missing.err, "error: cannot read 'x.imp': No such file or directory\n");
  EXPECT_EQ(test::imp({"check", "/"}).err, "error: cannot read '/': Is a directory\n");
  EXPECT_EQ(test::imp({"cast", sphere, "--rays", "no.csv"}).err,
            "error: cannot read 'no.csv': No such file or directory\n");
}

TEST(Command, says_when_output_cannot_be_written) {
  const std::vector<std::vector<std::string>> commands{
      {"--help"},
      {"list", "ops"},
      {"check", "--json", sphere},
      {"eval", sphere, "--points", "-", "--program", "f"},
      {"render", sphere, "--size", "8x8", "-o", "-"},
  };
  for (const auto& words : commands) {
    const CommandAnswer answer = test::imp(words, "x,y,z\n1,2,3\n", {}, "/dev/full");
    EXPECT_EQ(answer.exit, 1) << words[0];
    EXPECT_NE(answer.err.find("cannot write to standard output"), std::string::npos) << answer.err;
  }
}

TEST(Command, refuses_what_is_too_long_before_the_passes) {
  const Folder folder;
  const std::string file = folder.write("s.imp", "y = sum(i, 1, 7000, sin(i*x)/i)\n");
  const std::string rays = folder.write("r.csv", "ox,oy,oz,dx,dy,dz,tmin,tmax\n0,0,-5,0,0,1,0,10\n");
  const std::string picture = folder / "s.png";
  for (const auto& words : std::vector<std::vector<std::string>>{{"cast", file, "--rays", rays},
                                                                 {"render", file, "-o", picture},
                                                                 {"inspect", file, "--program", "cast"}}) {
    const CommandAnswer answer = test::imp(words);
    EXPECT_EQ(answer.exit, 1) << words[0];
    EXPECT_NE(answer.err.find("s.imp:1:1: error: this takes at least "), std::string::npos) << answer.err;
  }
  std::string parameters, surfaces;
  for (int i = 0; i < 1100; ++i) parameters += "param p" + std::to_string(i) + " = 1\n";
  const CommandAnswer shader =
      test::imp({"render", "-", "-o", picture, "--backend=glsl", "--size=8x8"}, parameters + "x = 0\n");
  EXPECT_NE(shader.err.find("inputs, and a shader has at most 1000"), std::string::npos) << shader.err;
  for (int i = 0; i < 2000; ++i) surfaces += fmt::format("surface s{0}: x - {0}\n", i);
  const CommandAnswer many = test::imp({"render", "-", "-o", picture, "--size=8x8"}, surfaces);
  EXPECT_NE(many.err.find("of 2000, the picture takes too many operations"), std::string::npos) << many.err;
}

TEST(Command, lists_what_there_is) {
  EXPECT_NE(test::imp({"list", "searches"}).out.find("stackless"), std::string::npos);
  EXPECT_NE(test::imp({"list", "inclusions"}).out.find("\nia "), std::string::npos);
  for (const Inclusion& inclusion : inclusions())
    EXPECT_NE(test::imp({"list", "inclusions"}).out.find(inclusion.name), std::string::npos);
  EXPECT_NE(test::imp({"list", "passes"}).out.find("canonicalize"), std::string::npos);
  EXPECT_NE(test::imp({"list", "ops"}).out.find("a < b ? a : b"), std::string::npos);
  EXPECT_NE(test::imp({"list", "targets"}).out.find("avx512"), std::string::npos);
  const CommandAnswer surfaces = test::imp({"list", "surfaces"}, {}, IMP_SOURCE_DIR);
  EXPECT_NE(surfaces.out.find("barth_sextic.imp"), std::string::npos) << surfaces.err;
}

}  // namespace
}  // namespace imp
