// Errors that are not ours: the user's, which point at the text, and the world's, which point at
// nothing. They are collected, never thrown.
//
//   ball.imp:1:33: error: unknown name 'foo'; did you mean 'floor'?
//   surface ball: sqrt(x*x + y*y) - foo
//                                   ^~~
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ir/span.h"

namespace imp {

// The texts that spans point into.
class Sources {
 public:
  std::uint32_t add(std::string name, std::string text);  // the file number
  std::string_view name(std::uint32_t file) const { return files_[file].name; }
  std::string_view text(std::uint32_t file) const { return files_[file].text; }
  std::size_t size() const { return files_.size(); }

 private:
  struct File {
    std::string name, text;
  };
  std::vector<File> files_;
};

enum class Severity : std::uint8_t { error, warning, note };

struct Diagnostic {
  Severity severity;
  Span span;  // invalid: the world's fault, no place to point at
  std::string message;
};

struct Position {
  std::size_t line, column;  // from 1; a column is a UTF-8 character
};

class Diagnostics {
 public:
  static constexpr std::size_t limit = 20;  // further errors are counted, not kept

  void error(Span span, std::string message) { add(Severity::error, span, std::move(message)); }
  void error(std::string message) { add(Severity::error, {}, std::move(message)); }
  void warning(Span span, std::string message) { add(Severity::warning, span, std::move(message)); }
  void note(Span span, std::string message) { add(Severity::note, span, std::move(message)); }

  bool has_errors() const { return errors_ > 0; }
  std::size_t errors() const { return errors_; }
  std::span<const Diagnostic> all() const { return all_; }

  Sources sources;

 private:
  void add(Severity severity, Span span, std::string message);

  std::vector<Diagnostic> all_;
  std::size_t errors_ = 0;
};

Position position(const Sources& sources, Span span);

// As a compiler prints it: place, severity, message, the line, a caret; long lines are cut around
// the caret. Ends with a newline.
std::string to_text(const Sources& sources, const Diagnostic& diagnostic);
std::string to_text(const Diagnostics& diagnostics);

// "; did you mean 'floor'?" for the known name nearest to `name`, or nothing.
std::string did_you_mean(std::string_view name, std::span<const std::string_view> known);

}  // namespace imp
