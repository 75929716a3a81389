// A piece of source text: bytes [begin, end) of file number `file`.
#pragma once

#include <cstdint>

namespace imp {

struct Span {
  std::uint32_t file = ~0u;  // index into Sources; ~0u: no place in a text
  std::uint32_t begin = 0;
  std::uint32_t end = 0;

  constexpr bool valid() const { return file != ~0u; }
  friend constexpr bool operator==(Span, Span) = default;
};

// The smallest span over both, of which either may be invalid.
constexpr Span join(Span a, Span b) {
  if (!a.valid()) return b;
  if (!b.valid() || a.file != b.file) return a;
  return {a.file, a.begin < b.begin ? a.begin : b.begin, a.end > b.end ? a.end : b.end};
}

}  // namespace imp
