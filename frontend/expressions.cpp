// Conditions and expressions, in the order of the grammar. Both are read by the same functions, for
// "(" may open either: what it was is known at the ")", and nothing is read twice.
#include <fmt/format.h>

#include "frontend/decimal.h"
#include "frontend/parser.h"

namespace imp::syntax {
namespace {

constexpr std::uint32_t deepest = 1000;  // levels that nest; an 8 MB stack holds several times as many

}  // namespace

// condition = conjunction { "or" conjunction }
Parser::Phrase Parser::condition() {
  Phrase left = conjunction();
  while (accept("or")) left = of_conditions(Op::or_, left, conjunction());
  return left;
}

// conjunction = negation { "and" negation }
Parser::Phrase Parser::conjunction() {
  Phrase left = negation();
  while (accept("and")) left = of_conditions(Op::and_, left, negation());
  return left;
}

// negation = [ "not" ] ( comparison | "(" condition ")" | NAME )
Parser::Phrase Parser::negation() {
  if (!at("not") || known("not")) return comparison();
  const Token word = take();
  const Phrase operand = comparison();
  expect_truth(operand);
  return emit(Op::not_, {word.begin, operand.end, true});
}

// comparison = expr ( "<" | "<=" | ">" | ">=" ) expr
Parser::Phrase Parser::comparison() {
  const auto at_sign = [&] { return at("<") || at("<=") || at(">") || at(">="); };
  const Phrase left = expr();
  if (!at_sign()) return left;
  const Token sign = take();
  const Phrase right = expr();
  expect_number(left);
  expect_number(right);
  if (at_sign()) fail(span(token_), "comparisons do not chain; write 'a < b and b < c'");
  const Phrase whole{left.begin, right.end, true};
  if (sign.text[0] == '>') emit(NodeKind::swap, Op::constant, 0, whole);
  return emit(sign.text.size() == 1 ? Op::lt : Op::le, whole);
}

// expr = term { ("+" | "-") term }
Parser::Phrase Parser::expr() {
  Phrase left = term();
  while (at("+") || at("-")) {
    const Op op = take().is("+") ? Op::add : Op::sub;
    left = of_numbers(op, left, term());
  }
  return left;
}

// term = unary { ("*" | "/") unary }
Parser::Phrase Parser::term() {
  Phrase left = unary();
  while (at("*") || at("/")) {
    const Op op = take().is("*") ? Op::mul : Op::div;
    left = of_numbers(op, left, unary());
  }
  return left;
}

// unary = { "-" | "+" } power
//
// Whatever nests passes here, so depth is bounded here.
Parser::Phrase Parser::unary() {
  if (depth_ == deepest) {
    fail(span(token_), fmt::format("nested more than {} levels deep", deepest));
    return {};
  }
  ++depth_;
  const std::uint32_t begin = token_.begin;
  bool negative = false, has_sign = false;
  for (; at("-") || at("+"); has_sign = true) negative ^= take().is("-");
  Phrase operand = power();
  if (has_sign) expect_number(operand);
  if (negative) operand = emit(Op::neg, {begin, operand.end});
  --depth_;
  return operand;
}

// power = primary [ "^" unary ]               right-associative: -x^2 is -(x^2)
Parser::Phrase Parser::power() {
  const Phrase base = primary();
  operand_end_ = previous_.end;
  if (!accept("^")) return base;
  const Phrase exponent = unary();
  expect_number(base);
  expect_number(exponent);
  const Phrase whole{base.begin, exponent.end};
  emit(NodeKind::power, Op::pow, 0, whole);
  return whole;
}

// primary = NUMBER | NAME | NAME "(" expr { "," expr } ")" | "if" "(" condition "," expr "," expr ")"
//         | "(" expr ")" | "|" expr "|"
Parser::Phrase Parser::primary() {
  if (token_.kind == TokenKind::number) return number();
  if (token_.kind == TokenKind::name) {
    const Token name = take();
    return at("(") ? call(name) : variable(name);
  }
  if (at("(")) return bracket();
  if (at("|")) return absolute();
  unexpected("an expression");
  return {};
}

Parser::Phrase Parser::number() {
  const Token token = take();
  if (!parse_decimal(token.text))
    error(span(token), quoted(token.text) + " has too many digits or is out of range (1e-323 to 1e308)");
  return emit(NodeKind::number, 0, token);
}

Parser::Phrase Parser::variable(const Token& name) {
  constexpr std::uint32_t first_parameter = 3;  // after x, y, z
  if (const auto slot = scope_.find(name.text)) return emit(NodeKind::local, *slot, name);
  if (is_coordinate(name.text))
    return emit(NodeKind::input, static_cast<std::uint32_t>(name.text[0] - 'x'), name);
  if (const Symbol* symbol = symbols_.find(name.text)) {
    switch (symbol->kind) {
      case Symbol::Kind::parameter:  return emit(NodeKind::input, first_parameter + symbol->index, name);
      case Symbol::Kind::time:       return emit(NodeKind::input, first_parameter + symbols_.parameters(), name);
      case Symbol::Kind::definition: break;
    }
    if (symbol->arity > 0) {
      error(span(name), fmt::format("{0} is a function; write {1}(...)", quoted(name.text), name.text));
      diagnostics_.note(symbol->span, "defined here");
    }
    return emit(NodeKind::definition, symbol->index, name);
  }
  if (const Builtin* builtin = find_builtin(name.text)) {
    if (builtin->arity > 0) error(span(name), fmt::format("'{0}' is a function; write {0}(...)", name.text));
    return emit(NodeKind::pi, 0, name);
  }
  unknown_name(name);
  return emit(NodeKind::integer, 0, name);
}

Parser::Phrase Parser::call(const Token& name) {
  const bool hidden = scope_.find(name.text) || is_coordinate(name.text);
  const Symbol* symbol = hidden ? nullptr : symbols_.find(name.text);
  const Builtin* builtin = hidden || symbol ? nullptr : find_builtin(name.text);
  if (builtin && builtin->meaning == Meaning::series) return series(name, *builtin);

  const std::uint32_t arity = symbol ? symbol->arity : builtin ? builtin->arity : 0;
  if (arity == 0) not_a_function(name);
  const std::uint32_t count = arguments(name, builtin);
  const bool or_more = builtin && builtin->meaning == Meaning::fold;
  if (arity > 0 && count != arity && !(or_more && count > arity)) wrong_arity(name, count, arity, or_more);

  const Phrase whole{name.begin, previous_.end};
  if (symbol && arity > 0) {
    emit(NodeKind::call, Op::call, symbol->index, whole);
  } else if (builtin) {
    switch (builtin->meaning) {
      case Meaning::op:
      case Meaning::choice:    emit(builtin->op, whole); break;
      case Meaning::power:     emit(NodeKind::power, Op::pow, 0, whole); break;
      case Meaning::chebyshev: emit(NodeKind::chebyshev, Op::constant, 0, whole); break;
      default:                 break;
    }
  }
  return whole;
}

// NAME "(" NAME "," expr "," expr "," expr ")", where the last expr knows the inner NAME
Parser::Phrase Parser::series(const Token& name, const Builtin& builtin) {
  const auto comma = [&] {
    if (at(")"))
      fail(span(name), fmt::format("'{0}' takes 4 arguments: {0}(i, first, last, body)", name.text));
    else
      expect(",");
  };
  const Token opened = open("(");
  const Token index = token_;
  if (index.kind != TokenKind::name)
    fail(span(index),
         fmt::format("'{0}' begins with the name of its index: {0}(i, first, last, body)", name.text));
  take();
  comma();
  real();
  comma();
  real();
  comma();
  const std::uint32_t header = emit(NodeKind::series, builtin.op, 0, {name.begin, name.end});
  scope_.push(index.text);
  real();
  scope_.pop();
  ast_.nodes[header].index = node_count();
  if (at(",")) fail(span(name), fmt::format("'{0}' takes 4 arguments: {0}(i, first, last, body)", name.text));
  close(opened);
  ast_.nodes[header].end = previous_.end;
  return {name.begin, previous_.end};
}

// "(" expr { "," expr } ")"; how many there are
std::uint32_t Parser::arguments(const Token& name, const Builtin* builtin) {
  const Token opened = open("(");
  std::uint32_t count = 0;
  if (!at(")")) {
    do {
      const Phrase argument = condition();
      if (!at(",") && !at(")")) break;  // and `close` complains
      if (builtin && builtin->meaning == Meaning::choice && count == 0)
        expect_truth(argument);
      else
        expect_number(argument);
      if (++count > 1 && builtin && builtin->meaning == Meaning::fold)
        emit(builtin->op, {name.begin, argument.end});
    } while (accept(","));
  }
  close(opened);
  return count;
}

Parser::Phrase Parser::bracket() {
  const Token opened = open("(");
  const Phrase inside = condition();
  close(opened);
  return {opened.begin, previous_.end, inside.truth};
}

Parser::Phrase Parser::absolute() {
  const Token opened = open("|");
  real();
  close(opened);
  return emit(Op::abs, {opened.begin, previous_.end});
}

Range Parser::real() {
  const std::uint32_t begin = node_count();
  expect_number(condition());
  return {begin, node_count()};
}

Parser::Phrase Parser::of_numbers(Op op, const Phrase& left, const Phrase& right) {
  expect_number(left);
  expect_number(right);
  return emit(op, {left.begin, right.end});
}

Parser::Phrase Parser::of_conditions(Op op, const Phrase& left, const Phrase& right) {
  expect_truth(left);
  expect_truth(right);
  return emit(op, {left.begin, right.end, true});
}

void Parser::expect_number(const Phrase& phrase) {
  if (phrase.truth && !failed_)
    error(span(phrase), "expected a number, not a condition; 'if(condition, a, b)' makes a number of one");
}

void Parser::expect_truth(const Phrase& phrase) {
  if (!phrase.truth && !failed_)
    error(span(phrase), "expected a condition, not a number; compare with <, <=, > or >=");
}

std::uint32_t Parser::emit(NodeKind kind, Op op, std::uint32_t index, Phrase place) {
  ast_.nodes.push_back({kind, op, index, place.begin, place.end});
  return node_count() - 1;
}

Parser::Phrase Parser::emit(NodeKind kind, std::uint32_t index, const Token& token) {
  emit(kind, Op::constant, index, {token.begin, token.end});
  return {token.begin, token.end};
}

Parser::Phrase Parser::emit(Op op, Phrase place) {
  emit(NodeKind::op, op, 0, place);
  return place;
}

}  // namespace imp::syntax
