#include "ir/diagnostics.h"

#include <gtest/gtest.h>

#include <array>

namespace imp {
namespace {

// The diagnostic about bytes [begin, end) of `text`.
std::string shown(const std::string& text, std::uint32_t begin, std::uint32_t end) {
  Diagnostics diagnostics;
  diagnostics.error({diagnostics.sources.add("a.imp", text), begin, end}, "wrong");
  return to_text(diagnostics);
}

TEST(Diagnostics, point_at_the_text) {
  EXPECT_EQ(shown("a = 1\nx + foo = 2\n", 10, 13),
            "a.imp:2:5: error: wrong\n"
            "x + foo = 2\n"
            "    ^~~\n");
}

TEST(Diagnostics, without_a_place_have_none) {
  Diagnostics diagnostics;
  diagnostics.error("out.png can't be written");
  EXPECT_EQ(to_text(diagnostics), "error: out.png can't be written\n");
}

TEST(Diagnostics, at_the_end_of_a_text) {
  EXPECT_EQ(shown("x +", 3, 3), "a.imp:1:4: error: wrong\nx +\n   ^\n");
  EXPECT_EQ(shown("x +\n", 4, 4), "a.imp:2:1: error: wrong\n\n^\n");
  EXPECT_EQ(shown("", 0, 0), "a.imp:1:1: error: wrong\n\n^\n");
}

TEST(Diagnostics, over_several_lines_mark_the_first) {
  EXPECT_EQ(shown("x + (y\n + z)", 4, 12), "a.imp:1:5: error: wrong\nx + (y\n    ^~\n");
}

TEST(Diagnostics, count_characters_not_bytes) {
  EXPECT_EQ(shown("ä·ö = é", 9, 11), "a.imp:1:7: error: wrong\nä·ö = é\n      ^\n");
}

TEST(Diagnostics, keep_tabs_and_hide_what_a_terminal_would_do) {
  EXPECT_EQ(shown("\tx\x1b\xff\ty\r\n", 5, 6), "a.imp:1:6: error: wrong\n\tx??\ty\n\t   \t^\n");
}

TEST(Diagnostics, cut_long_lines_around_the_caret) {
  std::string line;
  for (int i = 0; i < 100; ++i) line += "0123456789";
  const std::string text = shown(line, 500, 503);
  EXPECT_EQ(text, "a.imp:1:501: error: wrong\n..." + line.substr(430, 110) + "...\n" + std::string(73, ' ') +
                      "^~~\n");
  EXPECT_EQ(shown(line, 2, 1000),
            "a.imp:1:3: error: wrong\n" + line.substr(0, 110) + "...\n  ^" + std::string(107, '~') + "\n");
}

TEST(Diagnostics, are_short_in_one_endless_line) {
  EXPECT_LT(shown(std::string(10'000'000, 'x'), 9'000'000, 9'900'000).size(), 400u);
}

TEST(Diagnostics, beyond_the_limit_are_counted) {
  Diagnostics diagnostics;
  const std::uint32_t file = diagnostics.sources.add("a.imp", "x");
  for (int i = 0; i < 25; ++i) {
    diagnostics.error({file, 0, 1}, "wrong");
    diagnostics.note({file, 0, 1}, "why");
  }
  EXPECT_EQ(diagnostics.errors(), 25u);
  EXPECT_EQ(diagnostics.all().size(), 2 * Diagnostics::limit);
  EXPECT_TRUE(to_text(diagnostics).ends_with("error: 5 more errors are not shown\n"));
}

TEST(Diagnostics, warnings_are_no_errors) {
  Diagnostics diagnostics;
  diagnostics.warning({diagnostics.sources.add("a.imp", "x"), 0, 1}, "odd");
  EXPECT_FALSE(diagnostics.has_errors());
  EXPECT_EQ(to_text(diagnostics), "a.imp:1:1: warning: odd\nx\n^\n");
}

TEST(DidYouMean, the_nearest_name_or_nothing) {
  constexpr std::array<std::string_view, 8> known{"sqrt", "floor", "cos", "sin",
                                                  "sinh", "tau",   "x",   "radius"};
  const auto suggestion = [&](std::string_view name) { return did_you_mean(name, known); };
  EXPECT_EQ(suggestion("foo"), "; did you mean 'floor'?");
  EXPECT_EQ(suggestion("sqr"), "; did you mean 'sqrt'?");
  EXPECT_EQ(suggestion("Sin"), "; did you mean 'sin'?");
  EXPECT_EQ(suggestion("raduis"), "; did you mean 'radius'?");
  EXPECT_EQ(suggestion("snih"), "; did you mean 'sinh'?");
  EXPECT_EQ(suggestion("gradient"), "");
  EXPECT_EQ(suggestion("q"), "");
  EXPECT_EQ(suggestion(""), "");
  EXPECT_EQ(suggestion(std::string(1'000'000, 'a')), "");
  EXPECT_EQ(did_you_mean("sqr", {}), "");
}

}  // namespace
}  // namespace imp
