// Formulas as trees and as text: the expressions of docs/language.md read a second time. The reference of the
// attack evaluates these trees, so that it shares nothing with the frontend.
#pragma once

#include <cctype>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace imp::test {

// A number, a variable, or an operator or function over `args`. A minus sign is "-" of one or two operands.
struct Expression {
  std::string name;
  std::vector<Expression> args{};

  bool is(std::string_view other, std::size_t count) const { return name == other && args.size() == count; }
  bool is_number() const {
    return args.empty() && (std::isdigit(static_cast<unsigned char>(name[0])) || name[0] == '.');
  }
  bool operator==(const Expression&) const = default;
};

inline std::size_t size(const Expression& e) {
  std::size_t nodes = 1;
  for (const Expression& arg : e.args) nodes += size(arg);
  return nodes;
}

// How tightly an operator binds: what binds less stands in brackets inside it.
struct Binding {
  std::string_view name;
  std::size_t operands;
  int level;        // of the whole
  int left, right;  // of its operands at least
};
inline constexpr int loosest = 0, tightest = 9;
inline constexpr Binding bindings[] = {
    {"or", 2, 1, 1, 2}, {"and", 2, 2, 2, 3}, {"not", 1, 3, 3, 3}, {"<", 2, 4, 5, 5}, {"<=", 2, 4, 5, 5},
    {">", 2, 4, 5, 5},  {">=", 2, 4, 5, 5},  {"+", 2, 5, 5, 6},   {"-", 2, 5, 5, 6}, {"*", 2, 6, 6, 7},
    {"/", 2, 6, 6, 7},  {"-", 1, 7, 7, 7},   {"^", 2, 8, 9, 7},
};
inline const Binding* binding_of(const Expression& e) {
  for (const Binding& row : bindings)
    if (e.is(row.name, row.operands)) return &row;
  return nullptr;
}

inline std::string to_text(const Expression& e, int level = loosest) {
  const Binding* binding = binding_of(e);
  if (binding == nullptr) {
    std::string text = e.name;
    for (std::size_t i = 0; i < e.args.size(); ++i) text += (i == 0 ? "(" : ", ") + to_text(e.args[i]);
    return e.args.empty() ? text : text + ")";
  }
  std::string text;
  if (binding->operands == 1) {
    text = (e.name == "not" ? "not " : e.name) + to_text(e.args[0], binding->right);
  } else {
    const bool close = binding->level >= 6;
    text = to_text(e.args[0], binding->left) + (close ? e.name : " " + e.name + " ") +
           to_text(e.args[1], binding->right);
  }
  return binding->level < level ? "(" + text + ")" : text;
}

// Reads what to_text() writes, and all that the language has beside it. Throws on anything else.
class ExpressionReader {
 public:
  explicit ExpressionReader(std::string_view text) : text_(text) {}

  Expression whole() {
    Expression result = expr();
    if (!peek().empty()) fail("its end");
    return result;
  }
  Expression expr() {  // term { ("+" | "-") term }
    Expression left = term();
    while (peek() == "+" || peek() == "-") left = Expression{take(), {left, term()}};
    return left;
  }
  std::string take() {
    std::string token(peek());
    at_ = static_cast<std::size_t>(token_.data() - text_.data()) + token.size();
    token_ = {};
    return token;
  }
  // The next token; empty at the end.
  std::string_view peek() {
    if (!token_.empty()) return token_;
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
    token_ = text_.substr(at_, length());
    return token_;
  }
  bool skip(std::string_view token) {
    if (peek() != token) return false;
    take();
    return true;
  }

 private:
  [[noreturn]] void fail(const std::string& wanted) {
    throw std::runtime_error("'" + std::string(text_) + "': '" + std::string(peek()) + "' instead of " +
                             wanted);
  }
  void expect(std::string_view token) {
    if (!skip(token)) fail("'" + std::string(token) + "'");
  }

  std::size_t length() const {
    const auto is = [&](std::size_t i, auto test) {
      return i < text_.size() && test(static_cast<unsigned char>(text_[i]));
    };
    const auto digit = [](unsigned char c) { return std::isdigit(c) != 0; };
    const auto letter = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
    std::size_t end = at_;
    if (end >= text_.size()) return 0;
    if (is(end, digit) || (text_[end] == '.' && is(end + 1, digit))) {
      while (is(end, digit) || is(end, [](unsigned char c) { return c == '.'; })) ++end;
      std::size_t exponent = end;
      if (is(exponent, [](unsigned char c) { return c == 'e' || c == 'E'; })) {
        ++exponent;
        if (is(exponent, [](unsigned char c) { return c == '-' || c == '+'; })) ++exponent;
        if (is(exponent, digit)) end = exponent;
        while (is(end, digit)) ++end;
      }
      return end - at_;
    }
    if (is(end, letter)) {
      while (is(end, letter)) ++end;
      return end - at_;
    }
    return (text_[end] == '<' || text_[end] == '>') && is(end + 1, [](unsigned char c) { return c == '='; })
               ? 2
               : 1;
  }

  Expression term() {  // unary { ("*" | "/") unary }
    Expression left = unary();
    while (peek() == "*" || peek() == "/") left = Expression{take(), {left, unary()}};
    return left;
  }
  Expression unary() {  // { "-" | "+" } power
    if (skip("-")) return {"-", {unary()}};
    if (skip("+")) return unary();
    Expression base = primary();  // power = primary [ "^" unary ]
    if (skip("^")) return {"^", {base, unary()}};
    return base;
  }
  Expression primary() {
    if (skip("(")) {
      Expression inner = expr();
      expect(")");
      return inner;
    }
    if (skip("|")) {
      Expression inner = expr();
      expect("|");
      return {"abs", {inner}};
    }
    if (peek().empty() ||
        (!std::isalnum(static_cast<unsigned char>(peek()[0])) && peek()[0] != '.' && peek()[0] != '_'))
      fail("an operand");
    Expression result{take()};
    if (result.is_number() || !skip("(")) return result;
    do result.args.push_back(result.name == "if" && result.args.empty() ? condition() : expr());
    while (skip(","));
    expect(")");
    return result;
  }

  Expression condition() {  // conjunction { "or" conjunction }
    Expression left = conjunction();
    while (peek() == "or") left = Expression{take(), {left, conjunction()}};
    return left;
  }
  Expression conjunction() {  // negation { "and" negation }
    Expression left = negation();
    while (peek() == "and") left = Expression{take(), {left, negation()}};
    return left;
  }
  Expression negation() {  // [ "not" ] ( comparison | "(" condition ")" )
    if (skip("not")) return {"not", {negation()}};
    const std::size_t start = at_;
    if (peek() == "(") try {  // a condition in brackets, or a comparison whose left side begins with one
        take();
        Expression inner = condition();
        expect(")");
        return inner;
      } catch (const std::runtime_error&) { at_ = start, token_ = {}; }
    Expression left = expr();
    if (peek() != "<" && peek() != "<=" && peek() != ">" && peek() != ">=") fail("a comparison");
    std::string name = take();
    return {name, {left, expr()}};
  }

  std::string_view text_, token_{};
  std::size_t at_ = 0;
};

inline Expression read_expression(std::string_view text) { return ExpressionReader(text).whole(); }

}  // namespace imp::test
