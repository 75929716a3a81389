// Recursive descent over the statements of a file. Functions stand in the order of the grammar,
// which is the comment above each: statements in parser.cpp, expressions in expressions.cpp, what
// is said of text that fits neither in complaints.cpp.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "frontend/ast.h"
#include "frontend/builtins.h"
#include "frontend/model.h"
#include "frontend/scope.h"
#include "frontend/statements.h"
#include "frontend/symbols.h"

namespace imp::syntax {

class Parser {
 public:
  // Fills `ast`, and all of `model` but its Programs.
  Parser(const Symbols& symbols, Ast& ast, Model& model, Diagnostics& diagnostics);

  void file(std::span<const Statement> statements);

 private:
  // What a piece of text is: a number or a condition. Its nodes are the newest of the tree.
  struct Phrase {
    std::uint32_t begin = 0, end = 0;
    bool truth = false;
  };

  void statement(const Statement& statement);
  void param();
  void time();
  Parameter uniform(std::string_view prefix);
  void definition();
  void surface();
  void equation_alone();
  void equation(std::string name, Span name_span);
  void domain();
  void camera();
  void light();
  Point point(const std::string& name);
  Point default_point(const std::string& name, std::array<std::uint32_t, 3> values);
  Setting setting(std::string name, bool constant = false);
  Setting default_setting(std::string name, std::uint32_t value);

  Phrase condition();
  Phrase conjunction();
  Phrase negation();
  Phrase comparison();
  Phrase expr();
  Phrase term();
  Phrase unary();
  Phrase power();
  Phrase primary();
  Phrase number();
  Phrase variable(const Token& name);
  Phrase call(const Token& name);
  Phrase series(const Token& name, const Builtin& builtin);
  std::uint32_t arguments(const Token& name, const Builtin* builtin);
  Phrase bracket();
  Phrase absolute();

  // A condition of the grammar covers all expressions; these say which of the two must be there.
  Range real();
  Phrase of_numbers(Op op, const Phrase& left, const Phrase& right);
  Phrase of_conditions(Op op, const Phrase& left, const Phrase& right);
  void expect_number(const Phrase& phrase);
  void expect_truth(const Phrase& phrase);

  std::uint32_t emit(NodeKind kind, Op op, std::uint32_t index, Phrase place);
  Phrase emit(NodeKind kind, std::uint32_t index, const Token& token);
  Phrase emit(Op op, Phrase place);

  bool at(std::string_view word) const { return token_.text == word; }
  bool at_end() const { return token_.kind == TokenKind::end; }
  Token take();
  bool accept(std::string_view word);
  void expect(std::string_view word);
  Token expect_name(std::string_view what);
  Token open(std::string_view bracket);
  void close(const Token& opened);
  void finish();

  Span span(const Token& token) const { return {ast_.file, token.begin, token.end}; }
  Span span(const Phrase& phrase) const { return {ast_.file, phrase.begin, phrase.end}; }
  Span behind() const { return {ast_.file, previous_.end, previous_.end}; }  // the last token
  std::uint32_t node_count() const { return static_cast<std::uint32_t>(ast_.nodes.size()); }

  // Both report, unless this statement has failed before; to fail is to leave the rest of it.
  void error(Span place, std::string message);
  void fail(Span place, std::string message);
  void leave();
  void unexpected(std::string_view expected);
  bool unexpected_after_operand();
  void unsupported(const Token& word);
  void unknown_name(const Token& name);
  void not_a_function(const Token& name);
  void wrong_arity(const Token& name, std::uint32_t count, std::uint32_t arity, bool or_more);
  bool known(std::string_view name) const;
  const Symbol* declare(const Token& name);
  bool only_once(std::optional<Span>& first, const Token& keyword);
  void explain_first_word();
  void check_surfaces();

  const Symbols& symbols_;
  Ast& ast_;
  Model& model_;
  Diagnostics& diagnostics_;
  std::string_view text_;

  Lexer lexer_{{}, 0, 0};
  Token token_, previous_;
  std::size_t enough_errors_ = 0;  // at which parsing stops
  std::uint32_t statement_end_ = 0;
  std::uint32_t operand_end_ = ~0u;  // where the last primary ended
  std::vector<Token> open_;          // brackets and bars, the innermost last
  std::uint32_t depth_ = 0;
  bool failed_ = false;
  Scope scope_;

  std::optional<Span> domain_, camera_, time_;
  std::unordered_map<std::string, Span> surface_names_;
  std::optional<Span> nameless_;  // the first equation that is a statement by itself
};

}  // namespace imp::syntax
