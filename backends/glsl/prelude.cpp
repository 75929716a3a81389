#include "backends/glsl/prelude.h"

#include <algorithm>

#include "ir/assert.h"

namespace imp {
namespace {

struct Helper {
  std::string_view name;
  std::string_view text[2];  // for float and double; the second one empty: as the first
};

// $T is the type; the other words are in `layouts`. Each stands behind those that it calls.
constexpr Helper helpers[] = {
    {"raise",
     {R"(// The next number above r, or more, and no denormal: what rounded to r lies at or below it. If that is
// below zero, so is the result, or zero.
$T raise($T r, bool below) {
  precise $T raised = r + (abs(r) * $step + $tiny);
  precise $T result = below && raised > -$tiny ? $zero : raised;
  return r < -$largest ? -$largest : result;
}
)",
      ""}},
    {"add_up",
     {R"($T add_up($T a, $T b) {
  precise $T r = a + b;
  return a == -b ? r : raise(r, a < -b);
}
)",
      ""}},
    {"mul_up",
     {R"($T mul_up($T a, $T b) {
  precise $T r = a * b;
  return a == $zero || b == $zero ? $zero : raise(r, (a < $zero) != (b < $zero));
}
)",
      ""}},
    {"div_up",
     {R"($T div_up($T a, $T b) {
  precise $T r = a / b;
  return b == $zero ? $infinity : a == $zero ? r : raise(r, (a < $zero) != (b < $zero));
}
)",
      ""}},
    {"sqrt_up",
     {R"($T sqrt_up($T a) {
  precise $T r = sqrt(a);
  return a == $zero ? r : raise(r, false);
}
)",
      ""}},
    {"narrow_up",
     {R"(float narrow_up(double a) {
  precise float r = float(a);
  bool exact = a == zero_f64 || (double(r) >= a && abs(r) >= 1.17549435e-38);
  return exact ? r : raise(r, a < zero_f64);
}
)",
      ""}},
    {"exponent",
     {R"(float exponent(float a) {
  uint size = floatBitsToUint(a) & 0x7fffffffu;
  int e = size < 0x00800000u ? findMSB(size) - 149 : int(size >> 23) - 127;
  if (size == 0u) return uintBitsToFloat(0xff800000u);
  return size < 0x7f800000u ? float(e) : abs(a);
}
)",
      R"(double exponent(double a) {
  uvec2 bits = unpackDouble2x32(a);
  uint size = bits.y & 0x7fffffffu;
  int denormal = size != 0u ? findMSB(size) - 1042 : findMSB(bits.x) - 1074;
  int e = size < 0x00100000u ? denormal : int(size >> 20) - 1023;
  if ((size | bits.x) == 0u) return packDouble2x32(uvec2(0u, 0xfff00000u));
  return size < 0x7ff00000u ? double(e) : abs(a);
}
)"}},
    {"power_of_two",
     {"float power_of_two(int n, float like) { return uintBitsToFloat(uint(n + 127) << 23); }\n",
      "double power_of_two(int n, double like) { return packDouble2x32(uvec2(0u, uint(n + 1023) << 20)); "
      "}\n"}},
    {"scale2",
     {R"(// Three products with powers of two, of which at most one rounds.
$T scale2($T a, $T k) {
  precise $T clamped = floor(k < -$range ? -$range : k > $range ? $range : k);
  int all = int(clamped);
  int first = all < 1 - $bias ? -$shift : min(all, $bias);
  int rest = all - first;
  int second = rest < 1 - $bias ? -$shift : min(rest, $bias);
  precise $T r = a * power_of_two(first, a);
  precise $T s = r * power_of_two(second, a);
  precise $T t = s * power_of_two(rest - second, a);
  return isnan(k) ? k : t;
}
)",
      ""}},
    {"element",
     {R"(// The place of element i of a table: rounded down and clamped; 0 for NaN.
int element($T i, int length) {
  $T last = $T(length - 1);
  return i >= 1 ? int(i < last ? i : last) : 0;
}
)",
      ""}},
};

struct Word {
  std::string_view name;
  std::string_view text[2];
};

constexpr Word words[] = {
    {"$T", {"float", "double"}},
    {"$zero", {"zero", "zero_f64"}},
    {"$infinity", {"uintBitsToFloat(0x7f800000u)", "packDouble2x32(uvec2(0u, 0x7ff00000u))"}},
    {"$largest", {"3.4028235e+38", "1.7976931348623157e+308lf"}},
    {"$step", {"5.960465e-08", "1.1102230246251568e-16lf"}},
    {"$tiny", {"1.17549435e-38", "2.2250738585072014e-308lf"}},
    {"$bias", {"127", "1023"}},
    {"$shift", {"100", "960"}},
    {"$range", {"300.0", "2200.0lf"}},
};

std::string text_of(const Helper& helper, Scalar scalar) {
  const std::size_t type = scalar == Scalar::f64 ? 1 : 0;
  std::string text(helper.text[helper.text[type].empty() ? 0 : type]);
  for (const Word& word : words)
    for (std::size_t at = 0; (at = text.find(word.name, at)) != std::string::npos;)
      text.replace(at, word.name.size(), word.text[type]);
  return text;
}

}  // namespace

std::vector<std::string_view> helpers_in(std::string_view spelling) {
  std::vector<std::string_view> found;
  for (const Helper& helper : helpers)
    for (std::size_t at = 0; (at = spelling.find(helper.name, at)) != std::string_view::npos; ++at)
      if (spelling.substr(at + helper.name.size()).starts_with('(')) {
        found.push_back(helper.name);
        break;
      }
  return found;
}

std::vector<std::string_view> helper_names() {
  std::vector<std::string_view> names;
  for (const Helper& helper : helpers) names.push_back(helper.name);
  return names;
}

std::string prelude(const Helpers& used) {
  Helpers all = used;
  std::string text;
  for (std::size_t i = std::size(helpers); i-- > 0;)  // those that call come first
    for (const Scalar scalar : {Scalar::f64, Scalar::f32}) {
      if (!all.contains({helpers[i].name, scalar})) continue;
      const std::string function = text_of(helpers[i], scalar);
      // narrow_up takes a double, and raises a float.
      const Scalar inner = function.starts_with("float") ? Scalar::f32 : scalar;
      for (const std::string_view called : helpers_in(function))
        if (called != helpers[i].name) all.emplace(called, inner);
      text.insert(0, function + '\n');
    }
  return text;
}

}  // namespace imp
