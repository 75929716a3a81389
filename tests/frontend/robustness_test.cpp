// Any input is answered: by a Model that verifies, or by errors whose text can be shown. Inputs are so long that an
// answer in quadratic time would not come before the test's time is up.
#include <array>
#include <random>

#include "tests/frontend/parse.h"
#include "tests/support/effort.h"

namespace imp {
namespace {

using test::effort;

// The first error, or nothing where there is a Model.
std::string answer(std::string text) {
  Diagnostics diagnostics;
  const auto model = parse_model(std::move(text), "any.imp", diagnostics);
  EXPECT_EQ(model.has_value(), !diagnostics.has_errors());
  EXPECT_LE(diagnostics.all().size(), 100u);
  EXPECT_LT(to_text(diagnostics).size(), 100'000u);
  if (!model) return diagnostics.all()[0].message;
  for (const Surface& surface : model->surfaces)
    if (surface.f.graph.size() < 1000) { EXPECT_EQ(verify(surface.f), ""); }
  return "";
}

std::string repeated(std::string_view piece, std::size_t count) {
  std::string text;
  text.reserve(piece.size() * count);
  while (count-- > 0) text += piece;
  return text;
}

constexpr std::size_t many = effort(200'000);
const std::string deep = "nested more than 1000 levels deep";

std::string nested(std::string_view open, std::string_view close, std::size_t levels = many) {
  return repeated(open, levels) + "x" + repeated(close, levels);
}

TEST(Robustness, nesting_is_bounded) {
  EXPECT_EQ(answer(nested("(", ")")), deep);
  EXPECT_EQ(answer(nested("(", "")), deep);
  EXPECT_EQ(answer(nested("|", "|")), deep);
  EXPECT_EQ(answer(nested("-(", ")")), deep);
  EXPECT_EQ(answer(nested("sqrt(", ")")), deep);
  EXPECT_EQ(answer(nested("max(1, ", ")")), deep);
  EXPECT_EQ(answer(nested("sum(i, 1, 2, ", ")")), deep);
  EXPECT_EQ(answer(nested("if(1 < ", ", 1, 2)")), deep);
  EXPECT_EQ(answer(nested("x^", "")), deep);
  EXPECT_EQ(answer(nested("x^-", "")), deep);
  EXPECT_EQ(answer(nested("unknown(", ")")), "unknown name 'unknown'");
  EXPECT_EQ(answer("if(" + nested("not (", ")") + " < 1, 1, 2)"), deep);
  EXPECT_EQ(answer("f(a) = " + nested("(\n", ")")), deep);
}

TEST(Robustness, nesting_below_the_bound_is_fine) {
  EXPECT_EQ(answer(nested("(", ")", 990)), "");
  EXPECT_EQ(answer(nested("|x - ", "|", 990)), "");
  EXPECT_EQ(answer(nested("if(1 < ", ", 1, 2)", 990)), "");
  EXPECT_EQ(answer(nested("x^", "", 990)), "");
}

TEST(Robustness, what_does_not_nest_may_be_long) {
  EXPECT_EQ(answer(nested("-", "")), "");
  EXPECT_EQ(answer("x" + repeated(" + x", 30'000)), "");
  EXPECT_EQ(answer("x" + repeated("*x", 30'000)), "");
  EXPECT_EQ(answer("max(x" + repeated(", x", 30'000) + ")"), "");
  EXPECT_EQ(answer("if(x < 1" + repeated(" and x < 1", 100'000) + ", 1, 2)"), "");
  EXPECT_EQ(answer("x +" + repeated("\n", 1'000'000) + " y"), "");
  EXPECT_EQ(answer("x #" + repeated("#", 10'000'000)), "");
}

// a0 = a1 + x, a1 = a2 + x, ...
std::string chain(const std::string& parameter, int length) {
  std::string text;
  for (int i = 0; i < length; ++i)
    text += "a" + std::to_string(i) + parameter + " = a" + std::to_string(i + 1) + parameter + " + x\n";
  return text + "a" + std::to_string(length) + parameter + " = y\n";
}

TEST(Robustness, chains_of_definitions_may_be_long) {
  EXPECT_EQ(answer(chain("", 30'000) + "surface s: a0 = 0"), "");
  EXPECT_EQ(answer(chain("(t)", 30'000) + "surface s: a0(1) = 0"), "");
  EXPECT_EQ(answer(chain("", 100'000) + "param w = a0\nx = 1"),
            "'a0' depends on a coordinate, which has a value in surfaces only");
}

TEST(Robustness, expansion_is_bounded) {
  const std::string large = "expands to more than 1000000 operations";
  EXPECT_EQ(answer("x" + repeated("+x", 5'000'000)), large);
  EXPECT_EQ(answer("sum(i, 1, 1e9, x)"), large);
  EXPECT_EQ(answer("sum(i, 1, 2000, sum(j, 1, 2000, x))"), large);
  std::string doubling = "a0(t) = t\n";
  for (int i = 0; i < 64; ++i) {
    const std::string inner = "a" + std::to_string(i) + "(t)";
    doubling += "a" + std::to_string(i + 1) + "(t) = " + inner + " + " + inner + '\n';
  }
  EXPECT_EQ(answer(doubling + "surface s: a64(x) = 0"), large);
  std::string surfaces;
  for (int i = 0; i < 1000; ++i) surfaces += "surface s" + std::to_string(i) + ": sum(i, 1, 9999, x*i) = 0\n";
  EXPECT_EQ(answer(surfaces), large);
}

TEST(Robustness, a_formula_is_bounded) {
  const auto of = [](int count) {
    return "this takes " + std::to_string(count) +
           " operations, and a formula has at most 30000; let fewer terms or a shorter sum stand for it";
  };
  EXPECT_EQ(answer("y" + repeated(" + x", 30'001)), of(30'001));
  EXPECT_EQ(answer("sum(i, 1, 10000, sin(i*x)/i) - y"), of(39'998));
  EXPECT_EQ(answer(chain("", 100'000) + "surface s: a0 = 0"), of(100'000));
  EXPECT_EQ(answer(chain("(t)", 30'001) + "surface s: a0(1) = 0"), of(30'001));
}

TEST(Robustness, large_files_are_answered) {
  const std::size_t size = effort(10'000'000);
  EXPECT_NE(answer(repeated("x\n", size / 2)), "");
  EXPECT_NE(answer(repeated("(\n", size / 2)), "");
  EXPECT_NE(answer(repeated("f(a,\n", size / 5)), "");
  EXPECT_NE(answer(repeated("a", size)), "");
  EXPECT_NE(answer(repeated("1", size)), "");
  EXPECT_NE(answer("x = 1e" + repeated("1", size)), "");
  EXPECT_NE(answer("import \"" + repeated("a", size)), "");
  EXPECT_NE(answer(std::string(size, '\0')), "");
  EXPECT_NE(answer(repeated("a = 1\n", size / 6)), "");
  EXPECT_NE(answer(repeated("x ", size / 2)), "");
  EXPECT_EQ(answer(std::string((std::size_t{64} << 20) + 1, ' ')), "any.imp is larger than 64 MiB");
}

TEST(Robustness, many_errors_in_one_statement_are_cut_short) {
  std::string definitions, uses = "x";
  for (int i = 0; i < 200'000; ++i) {
    definitions += "name" + std::to_string(i) + " = 1\n";
    uses += " + nome" + std::to_string(i);
  }
  EXPECT_NE(answer(definitions + uses), "");
  EXPECT_NE(answer("x" + repeated(" + sqrt(x, (x < 1), foo)", 200'000)), "");
}

TEST(Robustness, garbage_is_answered) {
  std::mt19937 random(20240607);
  std::string bytes(effort(10'000'000), ' ');
  for (char& byte : bytes) byte = static_cast<char>(random());
  EXPECT_NE(answer(bytes), "");
  for (char& byte : bytes) byte = static_cast<char>(32 + random() % 95);
  EXPECT_NE(answer(bytes), "");
  for (char& byte : bytes)
    if (random() % 50 == 0) byte = '\n';
  EXPECT_NE(answer(bytes), "");
}

TEST(Robustness, token_soup_is_answered) {
  constexpr std::array words{
      "x",    "y",     "z",       "a",      "b",    "f",      "(",      ")",      "(",    ")",
      "[",    "]",     "|",       ",",      ":",    "=",      "+",      "-",      "*",    "/",
      "^",    "<",     ">=",      "and",    "or",   "not",    "if",     "sum",    "T",    "sqrt",
      "max",  "pi",    "1",       "2.5",    "1e9",  "\n",     "\n",     "\n  ",   "\n ",  "param",
      "time", "in",    "surface", "domain", "box",  "sphere", "radius", "camera", "from", "to",
      "fov",  "light", "solid",   "where",  "f(a)", "f(x) =", "a =",    "\"s\"",  "#",    "product"};
  std::mt19937 random(1);
  std::size_t models = 0;
  for (std::size_t i = 0; i < effort(20'000); ++i) {
    std::string text;
    for (std::size_t n = random() % 30; n > 0; --n) text += std::string(words[random() % words.size()]) + ' ';
    if (answer(text).empty()) ++models;
  }
  EXPECT_GT(models, effort(50));  // the soup is not too thick
}

// One change of one byte in a text that is right.
TEST(Robustness, typing_errors_are_answered) {
  const std::string text =
      "tau = (1 + sqrt(5))/2\nparam w = 1 in [0.5, 2]\nq(a, b) = a^2 - b^2\n"
      "surface s:\n  4*q(tau*x, y)*|z|^3\n    = sum(i, 1, 3, T(i, x)) + if(x < y and not z > w, 1, max(x, y, "
      "2))\n"
      "domain sphere(center: (0, 0, 0), radius: 2)\ncamera from (3, 2, 4) to (0, 0, 0) up (0, 0, 1) fov 30\n"
      "light direction (0, 0, 1) color (1, 1, 1) intensity 2\n";
  EXPECT_EQ(answer(text), "");
  std::mt19937 random(7);
  for (std::size_t i = 0; i < text.size(); ++i) {
    for (int k = 0; k < 20; ++k) {
      std::string changed = text;
      changed[i] = static_cast<char>(k < 4 ? random() : 32 + random() % 95);
      answer(changed);
    }
    answer(text.substr(0, i) + text.substr(i + 1));
    answer(text.substr(0, i));
  }
}

}  // namespace
}  // namespace imp
