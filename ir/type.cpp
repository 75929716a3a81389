#include "ir/type.h"

#include <fmt/format.h>

#include <charconv>

namespace imp {

std::string to_text(Type type) {
  const char* scalar = type.scalar == Scalar::truth ? "truth" : type.scalar == Scalar::f32 ? "f32" : "f64";
  return type.is_table() ? fmt::format("{}[{}]", scalar, type.length) : scalar;
}

std::optional<Type> type_named(std::string_view text) {
  std::uint32_t length = 0;
  if (const auto bracket = text.find('['); bracket != std::string_view::npos) {
    if (!text.ends_with(']')) return std::nullopt;
    const std::string_view digits = text.substr(bracket + 1, text.size() - bracket - 2);
    const char* last = digits.data() + digits.size();
    const auto [end, error] = std::from_chars(digits.data(), last, length);
    if (error != std::errc{} || end != last || length == 0) return std::nullopt;
    text = text.substr(0, bracket);
  }
  for (const Scalar scalar : {Scalar::truth, Scalar::f32, Scalar::f64})
    if (to_text(Type{scalar, 0}) == text) return Type{scalar, length};
  return std::nullopt;
}

}  // namespace imp
