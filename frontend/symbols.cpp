#include "frontend/symbols.h"

#include <optional>

namespace imp::syntax {
namespace {

std::optional<Symbol::Kind> kind_given_by(StatementKind statement) {
  switch (statement) {
    case StatementKind::param:      return Symbol::Kind::parameter;
    case StatementKind::time:       return Symbol::Kind::time;
    case StatementKind::definition: return Symbol::Kind::definition;
    default:                        return std::nullopt;
  }
}

// Of a definition, where `lexer` is behind its name.
std::uint32_t count_parameters(Lexer& lexer) {
  std::uint32_t count = 0;
  for (Token token = lexer.next(); token.kind != TokenKind::end; token = lexer.next()) {
    if (token.is("=") || token.is(")")) break;
    if (token.kind == TokenKind::name) ++count;
  }
  return count;
}

}  // namespace

Symbols::Symbols(std::span<const Statement> statements, std::string_view text, std::uint32_t file) {
  for (const Statement& statement : statements) {
    const auto kind = kind_given_by(statement.kind);
    if (!kind) continue;
    const bool definition = *kind == Symbol::Kind::definition;
    Lexer lexer(text, statement.begin, statement.end);
    if (!definition) lexer.next();
    const Token name = lexer.next();
    std::uint32_t& count = count_[static_cast<std::size_t>(*kind)];
    const Symbol symbol{*kind, count, definition ? count_parameters(lexer) : 0, {file, name.begin, name.end}};
    if (symbols_.try_emplace(name.text, symbol).second) ++count;
  }
}

const Symbol* Symbols::find(std::string_view name) const {
  const auto found = symbols_.find(name);
  return found == symbols_.end() ? nullptr : &found->second;
}

std::vector<std::string_view> Symbols::names() const {
  std::vector<std::string_view> names;
  names.reserve(symbols_.size());
  for (const auto& [name, symbol] : symbols_) names.push_back(name);
  return names;
}

}  // namespace imp::syntax
