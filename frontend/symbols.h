// The names that a file gives: known before anything is parsed, so that a name may be used before
// its definition.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "frontend/statements.h"
#include "ir/span.h"

namespace imp::syntax {

struct Symbol {
  enum class Kind : std::uint8_t { parameter, time, definition };

  Kind kind = Kind::definition;
  std::uint32_t index = 0;  // among those of its kind, in the order of the file
  std::uint32_t arity = 0;  // 0: a value
  Span span;                // of the name where it is defined
};

class Symbols {
 public:
  // Of names given twice the first counts.
  Symbols(std::span<const Statement> statements, std::string_view text, std::uint32_t file);

  const Symbol* find(std::string_view name) const;  // null: there is none
  std::uint32_t parameters() const { return count_[0]; }
  std::uint32_t definitions() const { return count_[2]; }
  std::vector<std::string_view> names() const;

 private:
  std::unordered_map<std::string_view, Symbol> symbols_;
  std::array<std::uint32_t, 3> count_{};  // by kind
};

}  // namespace imp::syntax
