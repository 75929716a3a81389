// What verbs read and say: files, models, diagnostics, tables on standard output.
#pragma once

#include <cstdio>
#include <optional>
#include <string>

#include "frontend/model.h"
#include "ir/diagnostics.h"

namespace imp::tools {

// The whole of a file, or of standard input where `path` is "-".
std::optional<std::string> read_text(const std::string& path, Diagnostics& diagnostics);

// A path as messages name it.
std::string shown_name(const std::string& path);

std::optional<Model> read_model(const std::string& path, Diagnostics& diagnostics);

// The index of the surface that is named, or of the only one where `name` is empty.
std::optional<std::size_t> choose_surface(const Model& model, const std::string& name,
                                          Diagnostics& diagnostics);

// To standard error, if it can be written: from where nothing may be thrown.
void say(std::string_view text) noexcept;

// To standard error.
void print(const Diagnostics& diagnostics);

// Standard output, in large pieces; remembers whether all of it could be written.
class Output {
 public:
  std::string text;  // what is still to be written

  void pass_on(bool all = false);        // writes `text` if there is much of it, or all of it
  bool close(Diagnostics& diagnostics);  // false: an error says what went wrong

 private:
  int error_ = 0;
};

}  // namespace imp::tools
