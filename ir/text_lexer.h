// The tokens of the text form (ir/text.h).
#pragma once

#include <string_view>

#include "ir/span.h"

namespace imp {

struct Token {
  enum Kind {
    word,     // march, f32, true, inf
    quoted,   // "my phase", with its quotes
    number,   // 0.5f, -3, -inf
    symbol,   // one of % . : = [ ] @ ,
    newline,  // one for many
    end,
    bad,
  };
  Kind kind;
  std::string_view text;
  Span span;

  bool is(char c) const { return kind == symbol && text[0] == c; }
  bool is(std::string_view w) const { return kind == word && text == w; }
};

class TextLexer {
 public:
  TextLexer(std::string_view text, std::uint32_t file) : text_(text), file_(file) {}

  Token next();

 private:
  Token take(Token::Kind kind, std::size_t size);
  void skip_blanks();
  std::size_t quoted_size() const;  // 0: no closing quote on the line
  std::size_t number_size() const;

  std::string_view text_;
  std::uint32_t file_;
  std::size_t at_ = 0;
};

}  // namespace imp
