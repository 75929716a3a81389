// Errors are tests too: the table is errors.imp-tests.
#include <gtest/gtest.h>

#include <fstream>

#include "frontend/model.h"

namespace imp {
namespace {

struct Case {
  int line = 0;  // of the table
  std::string source, said;
};

void PrintTo(const Case& c, std::ostream* out) { *out << "errors.imp-tests:" << c.line; }

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

std::vector<Case> read_cases() {
  std::ifstream file(IMP_SOURCE_DIR "/tests/frontend/errors.imp-tests");
  std::vector<Case> cases;
  Case current;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    if (line.empty()) {
      if (!current.said.empty()) cases.push_back(current);
      current = {.line = number + 1, .source = {}, .said = {}};
      continue;
    }
    if (line.starts_with("# ")) continue;
    const std::size_t mark = line.find("#!");
    current.source += line.substr(0, line.find_last_not_of(' ', mark == 0 ? 0 : mark - 1) + 1) + '\n';
    if (mark != std::string::npos) current.said += trimmed(line.substr(mark + 2)) + '\n';
  }
  if (!current.said.empty()) cases.push_back(current);
  return cases;
}

const char* word(Severity severity) {
  return severity == Severity::error ? "error" : severity == Severity::note ? "note" : "warning";
}

class Errors : public testing::TestWithParam<Case> {};

TEST_P(Errors, say_what_is_wrong_and_where) {
  Diagnostics diagnostics;
  EXPECT_FALSE(parse_model(GetParam().source, "file.imp", diagnostics));
  std::string said;
  for (const Diagnostic& d : diagnostics.all()) {
    const Position at = position(diagnostics.sources, d.span);
    said += std::to_string(at.line) + ':' + std::to_string(at.column) + ' ' + word(d.severity) + ": " +
            d.message + '\n';
  }
  EXPECT_EQ(said, GetParam().said) << GetParam().source;
}

INSTANTIATE_TEST_SUITE_P(Table, Errors, testing::ValuesIn(read_cases()),
                         [](const auto& test) { return "line_" + std::to_string(test.param.line); });

TEST(Errors, are_many) { EXPECT_GE(read_cases().size(), 120u); }

TEST(Errors, stop_at_the_limit) {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += "surface s: x +\n";
  Diagnostics diagnostics;
  EXPECT_FALSE(parse_model(text, "file.imp", diagnostics));
  EXPECT_GE(diagnostics.errors(), Diagnostics::limit);
  EXPECT_LE(diagnostics.errors(), Diagnostics::limit + 1);
}

// Several files may share one Diagnostics.
TEST(Errors, of_another_file_do_not_count) {
  Diagnostics diagnostics;
  EXPECT_FALSE(parse_model("x +", "a.imp", diagnostics));
  EXPECT_TRUE(parse_model("x = 1", "b.imp", diagnostics));
  EXPECT_FALSE(parse_model("", "c.imp", diagnostics));
  EXPECT_EQ(diagnostics.errors(), 2u);
}

TEST(Errors, name_a_null_byte) {
  Diagnostics diagnostics;
  EXPECT_FALSE(parse_model(std::string("x \0 = 1", 7), "a.imp", diagnostics));
  EXPECT_EQ(diagnostics.all()[0].message, "byte 0x00 is not part of the language");
}

}  // namespace
}  // namespace imp
