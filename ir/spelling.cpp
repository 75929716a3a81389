#include "ir/spelling.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>

namespace imp {
namespace {

template <class T>
std::string spell(T value, std::string_view suffix) {
  if (std::isnan(value)) return fmt::format("nan{}", suffix);  // a graph knows one NaN
  return fmt::format("{}{}", value, suffix);
}

template <class T>
std::optional<Literal> read(Type type, std::string_view text) {
  T value;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return Literal{type, value};
}

}  // namespace

bool is_word_start(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

bool is_word(char c) { return is_word_start(c) || (c >= '0' && c <= '9'); }

std::string spell_name(std::string_view name) {
  if (!name.empty() && is_word_start(name.front()) && std::ranges::all_of(name, is_word))
    return std::string(name);
  std::string quoted = "\"";
  for (const char c : name) {
    if (c == '"' || c == '\\')
      quoted += {'\\', c};
    else if (const auto byte = static_cast<unsigned char>(c); byte < 0x20 || byte == 0x7f)
      quoted += fmt::format("\\x{:02x}", byte);
    else
      quoted += c;
  }
  return quoted + '"';
}

std::optional<std::string> unquote(std::string_view quoted) {
  if (quoted.size() < 2 || quoted.front() != '"' || quoted.back() != '"') return std::nullopt;
  std::string name;
  for (std::string_view rest = quoted.substr(1, quoted.size() - 2); !rest.empty();) {
    std::size_t used = 1;
    if (rest[0] != '\\') {
      name += rest[0];
    } else if (rest.size() >= 2 && (rest[1] == '"' || rest[1] == '\\')) {
      name += rest[1];
      used = 2;
    } else if (rest.size() >= 4 && rest[1] == 'x') {
      unsigned char byte = 0;
      const auto [stop, error] = std::from_chars(rest.data() + 2, rest.data() + 4, byte, 16);
      if (error != std::errc{} || stop != rest.data() + 4) return std::nullopt;
      name += static_cast<char>(byte);
      used = 4;
    } else {
      return std::nullopt;
    }
    rest.remove_prefix(used);
  }
  return name;
}

std::string spell_constant(const Node& constant) {
  if (constant.type.is_truth()) return constant.payload != 0 ? "true" : "false";
  if (constant.type == f64) return spell(std::bit_cast<double>(constant.payload), "");
  return spell(std::bit_cast<float>(static_cast<std::uint32_t>(constant.payload)), "f");
}

std::optional<Literal> read_constant(std::string_view text) {
  if (text == "true" || text == "false") return Literal{truth, text == "true" ? 1.0 : 0.0};
  const bool digits_only = text == "inf" || text == "-inf";  // this f is no suffix
  if (!digits_only && text.ends_with('f')) return read<float>(f32, text.substr(0, text.size() - 1));
  return read<double>(f64, text);
}

}  // namespace imp
