#include "frontend/lexer.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace imp::syntax {
namespace {

constexpr std::uint32_t tab = 8;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool begins_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool continues_name(char c) { return begins_name(c) || is_digit(c); }
bool is_printable(char c) { return c > ' ' && c <= '~'; }

// Symbols of two characters. Some belong to other languages; they are read whole to be named whole.
constexpr std::array<std::string_view, 6> pairs{"<=", ">=", "==", "!=", "**", "&&"};

// The length of the UTF-8 character that `text` begins with; 1 for a byte that begins none.
std::uint32_t character_length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  const std::uint32_t length = lead < 0xC2 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : lead < 0xF5 ? 4 : 1;
  if (text.size() < length) return 1;
  for (std::uint32_t i = 1; i < length; ++i)
    if ((static_cast<unsigned char>(text[i]) & 0xC0) != 0x80) return 1;
  return length;
}

// Characters that formulas copied from elsewhere hold, and how they are written here.
struct Spelling {
  std::string_view foreign, ours;
};
constexpr std::array<Spelling, 14> spellings{{{"−", "-"},
                                              {"–", "-"},
                                              {"·", "*"},
                                              {"×", "*"},
                                              {"⋅", "*"},
                                              {"÷", "/"},
                                              {"²", "^2"},
                                              {"³", "^3"},
                                              {"⁴", "^4"},
                                              {"≤", "<="},
                                              {"≥", ">="},
                                              {"π", "pi"},
                                              {"√", "sqrt"},
                                              {"τ", "tau"}}};

std::string about_number(std::string_view text) {
  const auto points = std::ranges::count(text, '.');
  if (points > 1) return quoted(text) + " is not a number: it has more than one point";
  if (text.starts_with('.'))
    return fmt::format("a number begins with a digit; did you mean {}?", quoted(fmt::format("0{}", text)));
  if (text.ends_with('.'))
    return fmt::format("a digit is missing after the point; did you mean {}?",
                       quoted(fmt::format("{}0", text)));
  if (text.find_first_of("eE") == text.size() - 1)
    return quoted(text) + " is not a number: its exponent has no digits";
  return quoted(text) + " is not a number: its exponent is no whole number";
}

}  // namespace

std::string quoted(std::string_view text) {
  constexpr std::size_t longest = 40;
  return text.size() <= longest ? fmt::format("'{}'", text) : fmt::format("'{}...'", text.substr(0, longest));
}

bool is_coordinate(std::string_view name) { return name == "x" || name == "y" || name == "z"; }

Token Lexer::next() {
  skip_space();
  Token token;
  token.begin = token.end = at_;
  if (at_ >= text_.size()) return token;
  if (line_starts_) token.indent = indent_;
  line_starts_ = false;

  const char c = peek();
  token.kind = begins_name(c)                                   ? word()
               : is_digit(c) || (c == '.' && is_digit(peek(1))) ? number()
               : c == '"'                                       ? string()
                                                                : symbol();
  token.end = at_;
  token.text = text_.substr(token.begin, at_ - token.begin);
  return token;
}

void Lexer::skip_space() {
  for (; at_ < text_.size(); ++at_) {
    switch (text_[at_]) {
      case ' ':  ++indent_; break;
      case '\t': indent_ += tab - indent_ % tab; break;
      case '\r': break;
      case '\n': indent_ = 0, line_starts_ = true; break;
      case '#':  at_ = static_cast<std::uint32_t>(std::min(text_.find('\n', at_), text_.size()) - 1); break;
      default:   return;
    }
  }
}

TokenKind Lexer::word() {
  while (continues_name(peek())) ++at_;
  return TokenKind::name;
}

// NUMBER = digits with optional fraction and exponent
TokenKind Lexer::number() {
  const auto digits = [&] {
    const std::uint32_t begin = at_;
    while (is_digit(peek())) ++at_;
    return at_ > begin;
  };
  bool good = digits();
  if (peek() == '.') {
    ++at_;
    good = digits() && good;
  }
  if (peek() == 'e' || peek() == 'E') {
    const std::uint32_t sign = peek(1) == '+' || peek(1) == '-' ? 1 : 0;
    if (is_digit(peek(1 + sign))) {
      at_ += 1 + sign;
      digits();
    } else if (!continues_name(peek(1))) {  // else a name follows, as in 2exp(x)
      ++at_;
      good = false;
    }
  }
  for (; peek() == '.'; good = false) {
    ++at_;
    digits();
  }
  return good ? TokenKind::number : TokenKind::bad;
}

TokenKind Lexer::string() {
  const std::size_t close = text_.find_first_of("\"\n", at_ + 1);
  const bool closed = close != std::string_view::npos && text_[close] == '"';
  at_ = static_cast<std::uint32_t>(closed ? close + 1 : std::min(close, text_.size()));
  return closed ? TokenKind::string : TokenKind::bad;
}

TokenKind Lexer::symbol() {
  const std::string_view rest = text_.substr(at_);
  const bool pair = std::ranges::find(pairs, rest.substr(0, 2)) != pairs.end();
  at_ += pair ? 2 : character_length(rest);
  return is_printable(rest[0]) ? TokenKind::symbol : TokenKind::bad;
}

std::string complaint(const Token& bad) {
  const std::string_view text = bad.text;
  if (text[0] == '"') return "this string does not end on its line";
  if (text[0] == '.' || is_digit(text[0])) return about_number(text);
  const auto* known = std::ranges::find(spellings, text, &Spelling::foreign);
  if (known != spellings.end())
    return fmt::format("'{}' is not part of the language; did you mean '{}'?", text, known->ours);
  if (text.size() > 1) return fmt::format("'{}' is not part of the language", text);
  return fmt::format("byte 0x{:02X} is not part of the language", static_cast<unsigned char>(text[0]));
}

}  // namespace imp::syntax
