// Moving from token to token, and what is said where the wrong one comes.
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "frontend/parser.h"

namespace imp::syntax {
namespace {

// What other languages write.
struct Foreign {
  std::string_view symbol, advice;
};
constexpr std::array<Foreign, 10> foreign{{
    {"==", "an equation has one '=', a condition '<', '<=', '>' or '>='"},
    {"!=", "a condition has '<', '<=', '>' or '>='"},
    {"**", "did you mean '^'?"},
    {"&&", "did you mean 'and'?"},
    {"&", "did you mean 'and'?"},
    {"!", "did you mean 'not'?"},
    {"%", "did you mean 'mod(a, b)'?"},
    {"{", "did you mean '('?"},
    {"}", "did you mean ')'?"},
    {";", "a statement ends with its line"},
}};

// Words that may follow an expression: not a factor without its "*".
constexpr std::array<std::string_view, 12> continuations{
    "in", "to", "up", "fov", "height", "color", "where", "intensity", "radius", "material", "and", "or"};

bool begins_operand(const Token& token) {
  return token.kind == TokenKind::name || token.kind == TokenKind::number || token.is("(") || token.is("|");
}

// As a factor of a product that shows what was meant: 2, x, (...).
std::string factor(const Token& token) {
  if (token.is("(") || token.is(")")) return "(...)";
  if (token.is("|")) return "|...|";
  const std::string quote = quoted(token.text);
  return quote.substr(1, quote.size() - 2);
}

std::string_view closing(const Token& opened) { return opened.is("(") ? ")" : opened.is("[") ? "]" : "|"; }

}  // namespace

Token Parser::take() {
  previous_ = token_;
  token_ = lexer_.next();
  return previous_;
}

bool Parser::accept(std::string_view word) {
  if (!at(word)) return false;
  take();
  return true;
}

void Parser::expect(std::string_view word) {
  if (!accept(word)) unexpected(quoted(word));
}

Token Parser::expect_name(std::string_view what) {
  if (token_.kind == TokenKind::name) return take();
  unexpected(what);
  return token_;
}

Token Parser::open(std::string_view bracket) {
  const Token opened = token_;
  expect(bracket);
  open_.push_back(opened);
  return opened;
}

void Parser::close(const Token& opened) {
  if (failed_) return;
  if (accept(closing(opened))) return open_.pop_back();
  const bool in_bars = std::ranges::any_of(open_, [](const Token& token) { return token.is("|"); });
  const bool left_open = at_end() || at(")") || at("]") || (at("|") && in_bars);
  if (!left_open) return unexpected(quoted(closing(opened)));
  fail(at_end() ? behind() : span(token_), fmt::format("missing '{}'", closing(opened)));
  diagnostics_.note(span(opened), fmt::format("to close this '{}'", opened.text));
}

void Parser::finish() {
  if (!at_end()) unexpected("the end of the statement");
}

void Parser::error(Span place, std::string message) {
  if (failed_) return;
  diagnostics_.error(place, std::move(message));
  if (diagnostics_.errors() >= enough_errors_) leave();
}

void Parser::fail(Span place, std::string message) {
  error(place, std::move(message));
  leave();
}

void Parser::leave() {
  failed_ = true;
  lexer_ = Lexer(text_, statement_end_, statement_end_);
  token_ = lexer_.next();
}

void Parser::unexpected(std::string_view expected) {
  if (failed_) return;
  constexpr std::string_view indented =
      "; a line that continues a statement is indented deeper than its first";
  if (at_end()) {
    Lexer rest(text_, statement_end_, static_cast<std::uint32_t>(text_.size()));
    const bool last = rest.next().kind == TokenKind::end;
    return fail(behind(),
                fmt::format("expected {}, not the end of the statement{}", expected, last ? "" : indented));
  }
  if (token_.kind == TokenKind::bad) return fail(span(token_), complaint(token_));
  const auto* other = std::ranges::find(foreign, token_.text, &Foreign::symbol);
  if (other != foreign.end())
    return fail(span(token_),
                fmt::format("'{}' is not part of the language; {}", token_.text, other->advice));
  if (previous_.end == operand_end_ && unexpected_after_operand()) return;

  std::string advice;
  if (token_.kind == TokenKind::name)
    advice = did_you_mean(token_.text, continuations);
  else if (previous_.kind == TokenKind::end && token_.begin > 0)
    advice = indented;
  fail(span(token_), fmt::format("expected {}, not {}{}", expected, quoted(token_.text), advice));
}

// Behind an operand it is clearer what was meant; false where it is not.
bool Parser::unexpected_after_operand() {
  const Span place = span(token_);
  const bool continues =
      std::ranges::find(continuations, token_.text) != continuations.end() && !known(token_.text);
  if (at("|") && text_.substr(token_.end).starts_with('|')) {
    fail({ast_.file, token_.begin, token_.end + 1}, "'||' is not part of the language; did you mean 'or'?");
  } else if (begins_operand(token_) && !continues) {
    fail(join(span(previous_), place),
         fmt::format("an operator is missing; did you mean {}*{}?", factor(previous_), factor(token_)));
  } else if (at("=") && open_.empty()) {
    fail(place, "a statement has one '='");
  } else if (at("=")) {
    fail(place, "'=' can't stand in brackets; close them before it, or compare by <, <=, > or >=");
    diagnostics_.note(span(open_.back()), "opened here");
  } else if ((at(")") || at("]")) && open_.empty()) {
    fail(place, fmt::format("'{}' closes nothing", token_.text));
  }
  return failed_;
}

void Parser::unsupported(const Token& word) { fail(span(word), quoted(word.text) + " is not supported yet"); }

bool Parser::known(std::string_view name) const {
  return scope_.find(name) || is_coordinate(name) || symbols_.find(name) || find_builtin(name);
}

void Parser::unknown_name(const Token& name) {
  if (failed_) return;
  std::vector<std::string_view> names = scope_.names();
  std::ranges::copy(symbols_.names(), std::back_inserter(names));
  for (const Builtin& builtin : builtins()) names.push_back(builtin.name);
  error(span(name), fmt::format("unknown name {}{}", quoted(name.text), did_you_mean(name.text, names)));
}

void Parser::not_a_function(const Token& name) {
  if (failed_) return;
  if (!known(name.text)) return unknown_name(name);
  error(span(name),
        fmt::format("{} is not a function; did you mean {}*(...)?", quoted(name.text), factor(name)));
}

void Parser::wrong_arity(const Token& name, std::uint32_t count, std::uint32_t arity, bool or_more) {
  if (failed_) return;
  error(span(name), fmt::format("{} takes {}{} argument{}, not {}", quoted(name.text), arity,
                                or_more ? " or more" : "", arity == 1 ? "" : "s", count));
  if (const Symbol* symbol = symbols_.find(name.text)) diagnostics_.note(symbol->span, "defined here");
}

// The symbol that `name` gives, here and nowhere before.
const Symbol* Parser::declare(const Token& name) {
  if (failed_) return nullptr;
  if (is_coordinate(name.text)) {
    error(span(name), fmt::format("'{}' is a coordinate and can't be defined", name.text));
    return nullptr;
  }
  const Symbol* symbol = symbols_.find(name.text);
  if (symbol->span == span(name)) return symbol;
  const bool function = at("(");
  error(span(name), quoted(name.text) + " is defined twice" +
                        (function ? "; write 'surface NAME:' before an equation" : ""));
  diagnostics_.note(symbol->span, "first defined here");
  return nullptr;
}

bool Parser::only_once(std::optional<Span>& first, const Token& keyword) {
  if (!first) {
    first = span(keyword);
    return true;
  }
  const Span place = *first;
  fail(span(keyword), fmt::format("a file has at most one '{}'", keyword.text));
  diagnostics_.note(place, "the first is here");
  return false;
}

// An equation that begins with a word nobody defined was meant to be another statement.
void Parser::explain_first_word() {
  if (token_.kind != TokenKind::name || known(token_.text)) return;
  const auto words = keywords();
  const auto keyword = std::ranges::find(words, token_.text, &Keyword::word);
  if (keyword != words.end())
    return fail(span(token_),
                fmt::format("'{}' is not written like this; write {}", token_.text, keyword->usage));
  Lexer ahead = lexer_;
  const Token next = ahead.next();
  if (next.kind != TokenKind::name && !next.is(":")) return;
  std::vector<std::string_view> names;
  for (const Keyword& word : words) names.push_back(word.word);
  fail(span(token_),
       fmt::format("unknown statement {}{}", quoted(token_.text), did_you_mean(token_.text, names)));
}

void Parser::check_surfaces() {
  if (nameless_ && !surface_names_.empty())
    error(*nameless_, "one of several surfaces needs a name; write 'surface NAME:' before the equation");
}

}  // namespace imp::syntax
