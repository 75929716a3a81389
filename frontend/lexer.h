// The words of a .imp file. What is no word is a token too, so that only who reads it complains.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace imp::syntax {

enum class TokenKind : std::uint8_t { end, name, number, string, symbol, bad };

struct Token {
  static constexpr std::uint32_t not_first = ~0u;

  TokenKind kind = TokenKind::end;
  std::uint32_t begin = 0, end = 0;  // bytes of the text
  std::uint32_t indent = not_first;  // columns before it, where it is the first of its line
  std::string_view text;             // a string's with its quotes; empty at the end

  bool is(std::string_view word) const { return text == word; }
};

// Reads the words of [begin, end) in `text`; then the end, for ever.
class Lexer {
 public:
  Lexer(std::string_view text, std::uint32_t begin, std::uint32_t end)
      : text_(text.substr(0, end)), at_(begin), line_starts_(begin == 0) {}
  explicit Lexer(std::string_view text) : Lexer(text, 0, static_cast<std::uint32_t>(text.size())) {}

  Token next();

 private:
  char peek(std::uint32_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
  void skip_space();
  TokenKind word();
  TokenKind number();
  TokenKind string();
  TokenKind symbol();

  std::string_view text_;
  std::uint32_t at_;
  std::uint32_t indent_ = 0;
  bool line_starts_;
};

// What is wrong with a bad token.
std::string complaint(const Token& bad);

bool is_coordinate(std::string_view name);  // x, y or z

std::string quoted(std::string_view text);  // 'text', cut where it is long

}  // namespace imp::syntax
