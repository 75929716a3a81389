#include "ir/text_reader.h"

#include <charconv>

#include "ir/spelling.h"

namespace imp {

TextReader::TextReader(std::uint32_t file, Diagnostics& diagnostics)
    : lexer_(diagnostics.sources.text(file), file),
      diagnostics_(diagnostics),
      errors_before_(diagnostics.errors()),
      token_(lexer_.next()) {}

Token TextReader::take() {
  const Token taken = token_;
  before_ = taken.span;
  token_ = lexer_.next();
  return taken;
}

bool TextReader::accept(char c) {
  if (!token_.is(c)) return false;
  take();
  return true;
}

bool TextReader::expect(char c) {
  if (!token_.is(c)) fail(fmt::format("expected '{}'", c));
  return accept(c);
}

void TextReader::skip_newline() {
  if (token_.kind == Token::newline) take();
}

void TextReader::skip_rest() {
  while (!at_end_of_line()) take();
}

void TextReader::end_of_line() {
  if (!at_end_of_line() && !reported_) fail("expected the end of the line");
  skip_rest();
  skip_newline();
  reported_ = false;
}

std::optional<std::string> TextReader::name(std::string_view of) {
  std::optional<std::string> text;
  if (token_.kind == Token::word) text = std::string(token_.text);
  if (token_.kind == Token::quoted) text = unquote(token_.text);
  if (text)
    take();
  else
    fail(fmt::format("expected the name of {}", of));
  return text;
}

std::optional<std::uint32_t> TextReader::integer(std::string_view what) {
  std::uint32_t value = 0;
  const char* end = token_.text.data() + token_.text.size();
  const auto [stop, wrong] = std::from_chars(token_.text.data(), end, value);
  if (token_.kind != Token::number || wrong != std::errc{} || stop != end)
    return fail(fmt::format("expected {}", what)), std::nullopt;
  take();
  return value;
}

std::optional<Type> TextReader::type() {
  const Span at = token_.span;
  std::string text;
  if (token_.kind == Token::word) text = take().text;
  if (!text.empty() && accept('[')) {
    text += '[';
    if (token_.kind == Token::number) text += take().text;
    if (!expect(']')) return std::nullopt;
    text += ']';
  }
  const auto type = type_named(text);
  if (!type) error(text.empty() ? at : join(at, before_), "expected a type, like f32, f64, truth or f32[16]");
  return type;
}

void TextReader::error(Span at, std::string message) {
  if (!reported_) diagnostics_.error(at, std::move(message));
  reported_ = true;
}

void TextReader::fail(std::string message) {
  if (at_end_of_line())
    message += ", not the end of the line";
  else if (token_.kind == Token::quoted)
    message += ", not a quoted name";
  else if (token_.kind == Token::bad)
    message += token_.text[0] == '"' ? "; this quote is not closed" : ", not this character";
  else
    message += fmt::format(", not '{}'", token_.text);
  error(token_.span, std::move(message));
}

}  // namespace imp
