// Types of nodes: a number, a truth value, or a table of numbers of constant length.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace imp {

enum class Scalar : std::uint8_t { truth, f32, f64 };

struct Type {
  Scalar scalar = Scalar::f32;
  std::uint32_t length = 0;  // 0: one value; n > 0: a table of n values

  constexpr bool is_table() const { return length > 0; }
  constexpr bool is_real() const { return !is_table() && scalar != Scalar::truth; }
  constexpr bool is_truth() const { return !is_table() && scalar == Scalar::truth; }
  constexpr Type element() const { return {scalar, 0}; }
  friend constexpr bool operator==(Type, Type) = default;
};

inline constexpr Type truth{Scalar::truth, 0};
inline constexpr Type f32{Scalar::f32, 0};
inline constexpr Type f64{Scalar::f64, 0};

constexpr Type table_of(Type element, std::uint32_t length) { return {element.scalar, length}; }

// "f32", "f64", "truth", "f32[16]"
std::string to_text(Type type);
std::optional<Type> type_named(std::string_view text);

}  // namespace imp
