// Algebra as text: reading, matching and applying rules.
#include "passes/rules.h"

#include <algorithm>
#include <charconv>
#include <string>

#include "ir/assert.h"

namespace imp {
namespace {

std::string_view next_word(std::string_view& text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  const std::string_view word = text.substr(0, text.find(' '));
  text.remove_prefix(word.size());
  return word;
}

Term read_term(std::string_view& text) {
  using enum Term::Kind;
  const std::string_view word = next_word(text);
  if (word == "true" || word == "false") return {boolean, {}, 0, word == "true" ? 1.0 : 0.0, {}};
  if (word.size() == 1 && word[0] >= 'a' && word[0] <= 'z')
    return {word == "k" ? constant : any, {}, word[0], 0, {}};
  if (const auto op = op_named(word)) {
    Term term{Term::Kind::op, *op, 0, 0, {}};
    for (int i = 0; i < info(*op).arity; ++i) term.args.push_back(read_term(text));
    return term;
  }
  Term term{number, {}, 0, 0, {}};
  const auto end = std::from_chars(word.data(), word.data() + word.size(), term.value).ptr;
  IMP_ASSERT(!word.empty() && end == word.data() + word.size(), "an op, a letter or a number");
  return term;
}

bool match(const Graph& graph, const Term& term, Id id, Letters& letters);

bool match_all(const Graph& graph, const std::vector<Term>& terms, std::span<const Id> args,
               Letters& letters) {
  for (std::size_t i = 0; i < terms.size(); ++i)
    if (!match(graph, terms[i], args[i], letters)) return false;
  return true;
}

bool match_op(const Graph& graph, const Term& term, Op op, std::span<const Id> args, Letters& letters) {
  if (term.op != op) return false;
  const Letters before = letters;
  if (match_all(graph, term.args, args, letters)) return true;
  letters = before;
  return commutes(op) && match_all(graph, term.args, std::array{args[1], args[0]}, letters);
}

bool match(const Graph& graph, const Term& term, Id id, Letters& letters) {
  switch (term.kind) {
    case Term::Kind::op:      return match_op(graph, term, graph[id].op, graph[id].args, letters);
    case Term::Kind::number:  return graph.is_number(id, term.value);
    case Term::Kind::boolean: return graph.truth_value(id) == (term.value != 0);
    case Term::Kind::constant:
      if (!graph.number(id)) return false;
      break;
    case Term::Kind::any: break;
  }
  Id& bound = letters[term.letter];
  if (!bound.valid()) bound = id;
  return bound == id;
}

}  // namespace

Term parse_term(std::string_view text) {
  Term term = read_term(text);
  IMP_ASSERT(text.empty(), "one term");
  return term;
}

Id build(Graph& graph, const Term& term, const Letters& letters, Type type, const Algebra* algebra) {
  switch (term.kind) {
    case Term::Kind::number:   return graph.constant(type, term.value);
    case Term::Kind::boolean:  return graph.constant(term.value != 0);
    case Term::Kind::constant:
    case Term::Kind::any:      return letters[term.letter];
    case Term::Kind::op:       break;
  }
  std::vector<Id> args;
  args.reserve(term.args.size());
  for (const Term& arg : term.args) args.push_back(build(graph, arg, letters, type, algebra));
  return algebra ? algebra->add(graph, term.op, args) : graph.add(term.op, args);
}

Algebra::Algebra(std::span<const AlgebraRule> rules) {
  for (const AlgebraRule& rule : rules) {
    Parsed parsed{parse_term(rule.from), parse_term(rule.to), rule.when};
    rules_[static_cast<std::size_t>(parsed.from.op)].push_back(std::move(parsed));
  }
}

Id Algebra::add(Graph& graph, Op op, std::span<const Id> args) const {
  if (std::ranges::all_of(args, [&](Id arg) { return graph[arg].op == Op::constant; }))
    if (const Id id = graph.add(op, args); graph[id].op == Op::constant) return id;
  for (const Parsed& rule : rules_[static_cast<std::size_t>(op)]) {
    const auto fits = [&](std::span<const Id> operands, Letters& letters) {
      return match_all(graph, rule.from.args, operands, letters) &&
             (!rule.when || rule.when(*graph.number(letters['k'])));
    };
    Letters one, other;
    if (fits(args, one)) return build(graph, rule.to, one, graph[args[0]].type, this);
    if (commutes(op) && fits(std::array{args[1], args[0]}, other))
      return build(graph, rule.to, other, graph[args[0]].type, this);
  }
  return graph.add(op, args);
}

}  // namespace imp
