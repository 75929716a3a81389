// How names and constants are written in the text form (ir/text.h): printer and parser agree here.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "ir/graph.h"

namespace imp {

// `name` as it is where it is a plain word, else in quotes: bisect, "my phase", "a\"b", "\x0a".
std::string spell_name(std::string_view name);
bool is_word_start(char c);
bool is_word(char c);

// The bytes of a quoted name, given with its quotes; nothing if an escape is wrong.
std::optional<std::string> unquote(std::string_view quoted);

// The shortest text that reads back to the same constant: 0.1 (f64), 0.1f (f32), -0f, inf, true.
std::string spell_constant(const Node& constant);

struct Literal {
  Type type;     // f32, f64 or truth
  double value;  // truth: 0 or 1
};
// Nothing if the text is no constant, or one too large for its type.
std::optional<Literal> read_constant(std::string_view text);

}  // namespace imp
