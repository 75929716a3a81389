#include "frontend/decimal.h"

#include <algorithm>
#include <charconv>

namespace imp::syntax {
namespace {

constexpr std::size_t most_digits = 1000;
constexpr std::ptrdiff_t largest = 309, smallest = -324;  // decimal exponents of doubles
constexpr int chunk = 15;                                 // digits that every double holds

double small_power_of_ten(std::size_t n) {  // exact up to 10^22
  double power = 1;
  for (; n > 0; --n) power *= 10;
  return power;
}

Id power_of_ten(Graph& graph, int n) {
  if (n <= 22) return graph.constant(f64, small_power_of_ten(static_cast<std::size_t>(n)));
  return graph.add(Op::powi, {graph.constant(f64, 10), graph.constant(f64, n)});
}

Id integer(Graph& graph, std::string_view digits) {
  double value = 0;
  for (const char digit : digits) value = 10 * value + (digit - '0');
  return graph.constant(f64, value);
}

// a * 10^15 + b, and so on: exact, though no double may hold it.
Id mantissa(Graph& graph, std::string_view digits) {
  const std::size_t first = (digits.size() - 1) % chunk + 1;
  Id value = integer(graph, digits.substr(0, first));
  for (std::size_t at = first; at < digits.size(); at += chunk) {
    const Id shifted = graph.add(Op::mul, {value, power_of_ten(graph, chunk)});
    value = graph.add(Op::add, {shifted, integer(graph, digits.substr(at, chunk))});
  }
  return value;
}

// An exponent beyond any use is brought near; it is out of range all the same.
std::ptrdiff_t parse_exponent(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  std::ptrdiff_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  constexpr std::ptrdiff_t beyond = std::ptrdiff_t{1} << 40;
  if (error == std::errc::result_out_of_range) return text.starts_with('-') ? -beyond : beyond;
  return std::clamp(value, -beyond, beyond);
}

}  // namespace

std::optional<Decimal> parse_decimal(std::string_view text) {
  const std::size_t e = std::min(text.find_first_of("eE"), text.size());
  std::ptrdiff_t exponent = e < text.size() ? parse_exponent(text.substr(e + 1)) : 0;
  const std::size_t point = std::min(text.find('.'), e);

  std::string digits(text.substr(0, point));
  if (point < e) {
    digits += text.substr(point + 1, e - point - 1);
    exponent -= static_cast<std::ptrdiff_t>(e - point - 1);
  }
  digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size()));
  if (digits.empty()) return Decimal{};

  const auto magnitude = static_cast<std::ptrdiff_t>(digits.size()) + exponent;
  if (magnitude > largest || magnitude <= smallest) return std::nullopt;
  while (exponent < 0 && digits.back() == '0') digits.pop_back(), ++exponent;
  if (exponent > 0 && magnitude <= chunk)
    digits.append(static_cast<std::size_t>(exponent), '0'), exponent = 0;
  if (digits.size() > most_digits) return std::nullopt;
  return Decimal{std::move(digits), static_cast<int>(exponent)};
}

Id lower(const Decimal& decimal, Graph& graph) {
  if (decimal.digits.empty()) return graph.constant(f64, 0);
  const Id value = mantissa(graph, decimal.digits);
  const Op op = decimal.exponent < 0 ? Op::div : Op::mul;
  return graph.add(op, {value, power_of_ten(graph, std::abs(decimal.exponent))});
}

}  // namespace imp::syntax
