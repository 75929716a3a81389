// Where the statements of a file begin and end, and what each of them is. This is all there is to
// say about lines: a parser of one statement sees none.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "frontend/lexer.h"

namespace imp::syntax {

enum class StatementKind : std::uint8_t {
  import,
  param,
  time,
  definition,
  surface,
  solid,
  domain,
  isovalues,
  camera,
  light,
  material,
  equation,
};

struct Statement {
  StatementKind kind = StatementKind::equation;
  std::uint32_t begin = 0, end = 0;  // bytes of the text
};

// A line continues the statement above it if it is indented deeper than the line that began the
// statement, or if a bracket is open; but where a bracket was never closed, a line that can only be
// a new statement is one.
std::vector<Statement> split(std::string_view text);

// A statement that begins with a word of the language, and how it is written.
struct Keyword {
  std::string_view word;
  StatementKind kind;
  std::string_view usage;
};
std::span<const Keyword> keywords();

}  // namespace imp::syntax
