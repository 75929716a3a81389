// The ground the parser of the text form stands on: one token of look-ahead, small things that are
// read the same way everywhere, and errors at most once a line.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>

#include "ir/diagnostics.h"
#include "ir/text_lexer.h"
#include "ir/type.h"

namespace imp {

class TextReader {
 public:
  TextReader(std::uint32_t file, Diagnostics& diagnostics);

  bool ok() const { return diagnostics_.errors() == errors_before_; }

 protected:
  Token take();
  bool accept(char c);
  bool expect(char c);

  bool at_end_of_line() const { return token_.kind == Token::newline || token_.kind == Token::end; }
  void skip_newline();
  void skip_rest();
  void end_of_line();  // goes to the next line; complains about what is left, unless the line has an error

  std::optional<std::string> name(std::string_view of);
  std::optional<std::uint32_t> integer(std::string_view what);
  std::optional<Type> type();

  void error(Span at, std::string message);
  void fail(std::string message);  // at the current token, which is named

  template <class... Args>
  bool check(Span at, bool condition, fmt::format_string<Args...> form, Args&&... args) {
    if (!condition) error(at, fmt::format(form, std::forward<Args>(args)...));
    return condition;
  }

 private:
  TextLexer lexer_;
  Diagnostics& diagnostics_;
  std::size_t errors_before_;

 protected:
  Token token_;
  Span before_;            // of the token before it
  bool reported_ = false;  // this line has an error
};

}  // namespace imp
