#include "ir/text_lexer.h"

#include "ir/spelling.h"

namespace imp {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

// Spaces and comments. An empty line is not a token of its own.
void TextLexer::skip_blanks() {
  while (at_ < text_.size()) {
    const char c = text_[at_];
    if (c == '#')
      at_ = std::min(text_.find('\n', at_), text_.size());
    else if (c == ' ' || c == '\t' || c == '\r')
      ++at_;
    else
      return;
  }
}

Token TextLexer::take(Token::Kind kind, std::size_t size) {
  const auto begin = static_cast<std::uint32_t>(at_);
  at_ += size;
  return {kind, text_.substr(begin, size), {file_, begin, static_cast<std::uint32_t>(at_)}};
}

std::size_t TextLexer::quoted_size() const {
  for (std::size_t i = at_ + 1; i < text_.size() && text_[i] != '\n'; ++i) {
    if (text_[i] == '\\')
      ++i;
    else if (text_[i] == '"')
      return i + 1 - at_;
  }
  return 0;
}

// Anything that begins like a number, up to where no number goes on; spelling.h judges it. A point
// belongs to it before a digit only: f@2.y is the output y of f@2.
std::size_t TextLexer::number_size() const {
  const auto digit_at = [&](std::size_t i) { return i < text_.size() && is_digit(text_[i]); };
  std::size_t i = at_ + 1;
  for (; i < text_.size(); ++i) {
    const bool point = text_[i] == '.' && digit_at(i + 1);
    const bool sign = (text_[i] == '+' || text_[i] == '-') && (text_[i - 1] == 'e' || text_[i - 1] == 'E');
    if (!is_word(text_[i]) && !point && !sign) break;
  }
  return i - at_;
}

Token TextLexer::next() {
  skip_blanks();
  if (at_ >= text_.size()) return take(Token::end, 0);
  const char c = text_[at_];
  if (c == '\n') {
    Token token = take(Token::newline, 1);
    for (skip_blanks(); at_ < text_.size() && text_[at_] == '\n'; skip_blanks()) ++at_;
    return token;
  }
  if (is_word_start(c)) {
    std::size_t size = 1;
    while (at_ + size < text_.size() && is_word(text_[at_ + size])) ++size;
    return take(Token::word, size);
  }
  if (is_digit(c) || c == '-') return take(Token::number, number_size());
  if (c == '"') {
    const std::size_t size = quoted_size();
    return size > 0 ? take(Token::quoted, size) : take(Token::bad, 1);
  }
  if (std::string_view("%.:=[]@,").find(c) != std::string_view::npos) return take(Token::symbol, 1);
  std::size_t size = 1;  // the whole of a UTF-8 character, so that a message can show it
  while (at_ + size < text_.size() && (static_cast<unsigned char>(text_[at_ + size]) & 0xc0u) == 0x80u)
    ++size;
  return take(Token::bad, size);
}

}  // namespace imp
