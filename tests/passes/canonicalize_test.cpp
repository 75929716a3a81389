// Every rule of canonicalisation: it applies, and it keeps bits in nearest and in upward rounding.
#include "passes/canonicalize.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "ir/text.h"
#include "ir/verify.h"
#include "tests/support/evaluate.h"

namespace imp {
namespace {

using test::evaluate;
using test::same_bits;

// The type of every letter, from where it stands.
void types_of_letters(const Term& term, Type type, Type number, std::map<char, Type>& types) {
  if (term.letter != 0) types[term.letter] = type;
  for (std::size_t i = 0; i < term.args.size(); ++i) {
    const OpKind kind = info(term.op).kind;
    Type inner = number;
    if (kind == OpKind::logic || (kind == OpKind::choice && i == 0)) inner = truth;
    if (kind == OpKind::convert) inner = term.op == Op::widen ? f32 : f64;
    types_of_letters(term.args[i], inner, number, types);
  }
}

// Both sides of a rule as outputs of one Program, and each as the only output of another.
struct Sides {
  Program both, from, to;
};

Sides sides(const AlgebraRule& rule, Type number, double k) {
  const Term from = parse_term(rule.from), to = parse_term(rule.to);
  std::map<char, Type> types;
  types_of_letters(from, number, number, types);
  Program p;
  Letters letters{};
  for (const auto& [letter, type] : types) {
    letters[letter] =
        letter == 'k' ? p.graph.constant(type, k) : add_input(p, std::string(1, letter), type, Rate::ray);
  }
  const Id a = build(p.graph, from, letters, number), b = build(p.graph, to, letters, number);
  Sides result{p, p, p};
  result.both.outputs = {{"from", a}, {"to", b}};
  result.from.outputs = {{"f", a}};
  result.to.outputs = {{"f", b}};
  return result;
}

std::vector<double> constants_for(const AlgebraRule& rule) {
  if (!rule.from.contains('k')) return {0};
  std::vector<double> all(std::begin(test::special_values), std::end(test::special_values));
  all.insert(all.end(), {2, 4, 64, -4, 0x1p100});
  if (rule.from.starts_with("powi")) all = {2, 4, 8, 64, 3, -2};
  if (rule.when) std::erase_if(all, [&](double k) { return !rule.when(k); });
  return all;
}

// Calls `visit` with every choice of special values for the inputs.
template <class Visit>
void for_all_inputs(const Program& p, std::vector<double>& values, Visit visit) {
  if (values.size() == p.inputs.size()) return visit(values);
  const bool logical = p.inputs[values.size()].type.is_truth();
  for (const double value : test::special_values) {
    if (logical && value != 0 && value != 1) continue;
    values.push_back(value);
    for_all_inputs(p, values, visit);
    values.pop_back();
  }
}

void expect_same_bits(const AlgebraRule& rule, const Program& both) {
  const auto nearest = interpret(both), upward = interpret(test::upward(both));
  std::vector<double> values;
  int failures = 0;
  for_all_inputs(both, values, [&](std::vector<double> in) {
    const auto near = evaluate(*nearest, in);
    in.push_back(0);
    const auto up = evaluate(*upward, in);
    if (same_bits(near[0], near[1]) && same_bits(up[0], up[1])) return;
    if (++failures > 3) return;
    ADD_FAILURE() << rule.from << " -> " << rule.to << " at " << testing::PrintToString(in) << ": nearest "
                  << near[0] << " and " << near[1] << ", upward " << up[0] << " and " << up[1];
  });
}

TEST(Canonicalize, every_rule_keeps_bits) {
  for (const AlgebraRule& rule : canonical_rules())
    for (const Type number : {f64, f32})
      for (const double k : constants_for(rule)) expect_same_bits(rule, sides(rule, number, k).both);
}

TEST(Canonicalize, every_rule_applies) {
  for (const AlgebraRule& rule : canonical_rules())
    for (const double k : constants_for(rule)) {
      const Sides s = sides(rule, f64, k);
      EXPECT_TRUE(canonicalize(s.from) == canonicalize(s.to))
          << rule.from << " -> " << rule.to << '\n'
          << to_text(canonicalize(s.from)) << to_text(canonicalize(s.to));
      EXPECT_EQ(verify(canonicalize(s.from)), "");
    }
}

// A rule that the graph's own folds have made idle is one too many.
TEST(Canonicalize, no_rule_is_idle) {
  for (const AlgebraRule& rule : canonical_rules()) {
    bool applies = false;
    for (const double k : constants_for(rule)) {
      const Sides s = sides(rule, f64, k);
      applies = applies || !(canonicalize(s.from) == s.from);
    }
    EXPECT_TRUE(applies) << rule.from;
  }
}

TEST(Canonicalize, rules_are_different) {
  std::set<std::string_view> seen;
  for (const AlgebraRule& rule : canonical_rules()) EXPECT_TRUE(seen.insert(rule.from).second) << rule.from;
}

TEST(Canonicalize, finds_what_is_common) {
  Program p;
  const Expr x{&p.graph, add_input(p, "x", f64, Rate::ray)}, y{&p.graph, add_input(p, "y", f64, Rate::ray)};
  p.outputs = {{"f", (x - y).id}, {"g", (-y + x).id}, {"h", (x + y * -1.0).id}};
  const Program q = canonicalize(p);
  EXPECT_EQ(q.outputs[0].id, q.outputs[1].id);
  EXPECT_EQ(q.outputs[0].id, q.outputs[2].id);
}

TEST(Canonicalize, tries_both_orders_for_a_constant) {
  Program p;
  const Expr a{&p.graph, p.graph.constant(f64, -1)}, b{&p.graph, p.graph.constant(f64, 0.1)};
  p.outputs = {{"f", (a + b).id}};
  const Program q = canonicalize(p);
  EXPECT_EQ(q.graph[q.outputs[0].id].op, Op::sub);
}

TEST(Canonicalize, leaves_what_would_round_differently) {
  Program p;
  const Expr x{&p.graph, add_input(p, "x", f64, Rate::ray)}, y{&p.graph, add_input(p, "y", f64, Rate::ray)};
  p.outputs = {{"a", (-(x * y)).id}, {"b", (-x * y).id},
               {"c", (-x - y).id},   {"d", (x + 0.0).id},
               {"e", (x * 0.0).id},  {"f", (x - x).id},
               {"g", (x / x).id},    {"h", (0.0 - x).id},
               {"i", (x / 3.0).id},  {"j", make(Op::powi, -x, constant_like(x, 6)).id},
               {"k", max(x, -x).id}};
  EXPECT_TRUE(canonicalize(p) == p) << to_text(canonicalize(p));
}

}  // namespace
}  // namespace imp
