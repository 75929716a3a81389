#include "frontend/statements.h"

#include <algorithm>
#include <array>

#include "frontend/builtins.h"

namespace imp::syntax {
namespace {

constexpr std::array<Keyword, 10> table{{
    {"import", StatementKind::import, "import \"file.imp\""},
    {"param", StatementKind::param, "param NAME = 1 in [0, 2]"},
    {"time", StatementKind::time, "time NAME = 0 in [0, 1]"},
    {"surface", StatementKind::surface, "surface NAME: x^2 + y^2 + z^2 = 1"},
    {"solid", StatementKind::solid, "solid NAME: x < 0 and y < 0"},
    {"domain", StatementKind::domain, "domain box((-1, -1, -1), (1, 1, 1)) or domain sphere(radius: 1)"},
    {"isovalues", StatementKind::isovalues, "isovalues 0, 1"},
    {"camera", StatementKind::camera, "camera from (3, 2, 4) to (0, 0, 0) fov 30"},
    {"light", StatementKind::light, "light from (3, 5, 4) or light direction (0, -1, 0)"},
    {"material", StatementKind::material, "material NAME: color (1, 1, 1)"},
}};

// Keywords are contextual: `time = 3` and `light(a) = 2*a` are definitions.
bool fits(StatementKind kind, const Token& next) {
  switch (kind) {
    case StatementKind::import: return next.text.starts_with('"');
    case StatementKind::domain: return next.is("box") || next.is("sphere");
    case StatementKind::camera: return next.is("from");
    case StatementKind::light:  return next.is("from") || next.is("direction");
    case StatementKind::isovalues:
      return next.kind == TokenKind::number || next.kind == TokenKind::name || next.is("-");
    default: return next.kind == TokenKind::name;
  }
}

// Where a line that is indented no deeper than the first begins the next statement.
bool begins_line(const Token& token, std::uint32_t indent) {
  return token.indent != Token::not_first && token.indent <= indent;
}

// The rest of `NAME "(" NAME { "," NAME } ")" "="`, from the first parameter on. A built-in function
// of a coordinate is an equation: sin(x) = z.
bool heads_function(const Token& name, Lexer ahead) {
  const bool builtin = find_builtin(name.text) != nullptr;
  while (true) {
    const Token parameter = ahead.next();
    if (parameter.kind != TokenKind::name || (builtin && is_coordinate(parameter.text))) return false;
    const Token after = ahead.next();
    if (after.is(")")) {
      const Token sign = ahead.next();
      return sign.is("=") && !begins_line(sign, name.indent);
    }
    if (!after.is(",")) return false;
  }
}

// What the statement that begins with `first`, and goes on in `ahead`, is.
StatementKind classify(const Token& first, Lexer ahead) {
  if (first.kind != TokenKind::name) return StatementKind::equation;
  const Token second = ahead.next();
  if (begins_line(second, first.indent)) return StatementKind::equation;
  const bool defines = second.is("=") || (second.is("(") && heads_function(first, ahead));
  if (defines && !is_coordinate(first.text)) return StatementKind::definition;
  const auto* keyword = std::ranges::find(table, first.text, &Keyword::word);
  return keyword != table.end() && fits(keyword->kind, second) ? keyword->kind : StatementKind::equation;
}

}  // namespace

std::span<const Keyword> keywords() { return table; }

std::vector<Statement> split(std::string_view text) {
  std::vector<Statement> statements;
  Lexer lexer(text);
  std::uint32_t indent = 0;
  std::size_t open = 0;
  for (Token token = lexer.next(); token.kind != TokenKind::end; token = lexer.next()) {
    const bool may_begin = statements.empty() || begins_line(token, indent);
    if (may_begin) {
      const StatementKind kind = classify(token, lexer);
      if (statements.empty() || open == 0 || kind != StatementKind::equation) {
        statements.push_back({kind, token.begin, token.end});
        indent = token.indent;
        open = 0;
      }
    }
    if (token.is("(") || token.is("[")) ++open;
    if ((token.is(")") || token.is("]")) && open > 0) --open;
    statements.back().end = token.end;
  }
  return statements;
}

}  // namespace imp::syntax
