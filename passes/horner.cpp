#include "passes/horner.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdlib>
#include <optional>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "passes/chains.h"
#include "passes/power.h"
#include "passes/rewrite.h"

namespace imp {
namespace {

struct Factor {
  Id base;
  std::uint32_t exponent;
};

struct ProductTerm {
  std::vector<Factor> factors;
  bool negative = false;
  Signed written{};  // the same, where the graph has it
};

// What some terms have in common, and what it saves: products, and those with variables first, as they cost
// an enclosure the most.
struct Common {
  Factor factor{};
  std::size_t terms = 0, products = 0;
  bool variable = false;

  std::size_t saved() const { return products == 0 ? 0 : (products - 1) * (variable ? 4 : 1); }
  bool better_than(const Common& other) const {
    return std::tuple(saved(), terms, factor.exponent) >
           std::tuple(other.saved(), other.terms, other.factor.exponent);
  }
};

// Whether x^m is x^k x^(m - k) to enclosures too: on both sides of 0, x x is wider than x^2.
bool divides(std::uint32_t k, std::uint32_t m) { return m == k || (m > k && k % 2 == 0 && m % 2 == 0); }

constexpr std::uint32_t largest_exponent = 1 << 20;  // of Op::powi

class Horner {
 public:
  explicit Horner(const Program& program)
      : old_(program.graph), chains_(program), regions_(regions(program)), now_(program.graph.size()) {}

  Id operator()(Graph& graph, Id old, const Node& node) {
    graph_ = &graph;
    std::optional<Signed> result;
    if (chains_.is_sum(old)) {
      type_ = node.type;
      result = factored(terms_of(old));
    }
    return now_[old.index] = result ? result->resolved().id : copy(graph, node);
  }

 private:
  Expr expr(Id id) const { return {graph_, id}; }
  Id now(Id old) const { return now_[old.index]; }

  std::vector<ProductTerm> terms_of(Id sum) const {
    std::vector<ProductTerm> terms;
    for (const Operand& operand : chains_.operands(sum)) {
      ProductTerm term{{}, operand.negative, {expr(now(operand.id)), operand.negative}};
      take_factors(operand.id, term);
      terms.push_back(std::move(term));
    }
    return terms;
  }

  void take_factors(Id product, ProductTerm& term) const {
    std::vector<Id> open{product};
    while (!open.empty()) {
      const Id id = open.back();
      open.pop_back();
      const Node node = old_[id];
      const auto number = node.args.size() == 2 ? old_.number(node.args[1]) : std::nullopt;
      if (regions_[id.index] == Region::constant()) {
        take_constant(expr(now(id)), term);
      } else if (node.op == Op::mul && !chains_.is_shared(id)) {
        open.insert(open.end(), {node.args[1], node.args[0]});
      } else if (node.op == Op::div && !chains_.is_shared(id) && number && std::isnormal(*number)) {
        take_constant(1.0 / expr(now(node.args[1])), term);
        open.push_back(node.args[0]);
      } else if (node.op == Op::neg) {
        term.negative = !term.negative;
        open.push_back(node.args[0]);
      } else if (node.op == Op::powi && *number >= 1) {
        multiply(term, {now(node.args[0]), static_cast<std::uint32_t>(*number)});
      } else {
        multiply(term, {now(id), 1});
      }
    }
  }

  void take_constant(Expr constant, ProductTerm& term) const {
    const auto number = graph_->number(constant.id);
    if (number && std::signbit(*number)) {
      term.negative = !term.negative;
      constant = constant_like(constant, -*number);
    }
    if (!graph_->is_number(constant.id, 1)) multiply(term, {constant.id, 1});
  }

  static void multiply(ProductTerm& term, Factor factor) {
    for (Factor& known : term.factors)
      if (known.base == factor.base && known.exponent <= largest_exponent - factor.exponent) {
        known.exponent += factor.exponent;
        return;
      }
    term.factors.push_back(factor);
  }

  static Factor* find(ProductTerm& term, Factor common) {
    const auto it = std::ranges::find_if(term.factors, [&](const Factor& factor) {
      return factor.base == common.base && divides(common.exponent, factor.exponent);
    });
    return it == term.factors.end() ? nullptr : &*it;
  }

  Common most_in_common(std::vector<ProductTerm>& terms) const {
    std::unordered_map<Id, std::size_t> occurrences;
    for (const ProductTerm& term : terms)
      for (const Factor& factor : term.factors) ++occurrences[factor.base];
    Common best;
    std::set<std::pair<Id, std::uint32_t>> tried;
    for (const ProductTerm& candidate : terms)
      for (const Factor& factor : candidate.factors) {
        if (occurrences[factor.base] < 2 || !tried.emplace(factor.base, factor.exponent).second) continue;
        const Common common = count(terms, factor);
        if (common.terms >= 2 && common.better_than(best)) best = common;
      }
    return best;
  }

  Common count(std::vector<ProductTerm>& terms, Factor factor) const {
    Common common{factor, 0, 0, !graph_->number(factor.base)};
    for (ProductTerm& term : terms) {
      const Factor* found = find(term, factor);
      if (!found) continue;
      ++common.terms;
      if (term.factors.size() > 1 || found->exponent > factor.exponent) ++common.products;
    }
    return common;
  }

  // The sum of the terms; nothing if no two of them have anything in common.
  std::optional<Signed> factored(std::vector<ProductTerm> terms) const {
    const Common common = most_in_common(terms);
    if (common.terms < 2) return std::nullopt;
    std::vector<ProductTerm> with_it, rest;
    for (ProductTerm& term : terms) {
      Factor* factor = find(term, common.factor);
      if (!factor) {
        rest.push_back(std::move(term));
        continue;
      }
      factor->exponent -= common.factor.exponent;
      std::erase_if(term.factors, [](const Factor& each) { return each.exponent == 0; });
      term.written = {};
      with_it.push_back(std::move(term));
    }
    const Signed cofactor = sum(std::move(with_it));
    const Signed product{power(common.factor) * cofactor.value, cofactor.negative};
    return rest.empty() ? product : product + sum(std::move(rest));
  }

  Signed sum(std::vector<ProductTerm> terms) const {
    if (const auto result = factored(terms)) return *result;
    Signed result = value(terms[0]);
    for (std::size_t i = 1; i < terms.size(); ++i) result = result + value(terms[i]);
    return result;
  }

  Signed value(const ProductTerm& term) const {
    if (term.written.value.graph) return term.written;
    if (term.factors.empty()) return {expr(graph_->constant(type_, 1)), term.negative};
    Expr product = power(term.factors[0]);
    for (std::size_t i = 1; i < term.factors.size(); ++i) product = product * power(term.factors[i]);
    return {product, term.negative};
  }

  Expr power(Factor factor) const {
    const Expr base = expr(factor.base);
    return factor.exponent == 1 ? base : make(Op::powi, base, constant_like(base, factor.exponent));
  }

  const Graph& old_;
  Chains chains_;
  std::vector<Region> regions_;
  std::vector<Id> now_;  // of the nodes so far
  Graph* graph_ = nullptr;
  Type type_{};
};

// What gets less from round to round: the ops a kernel has; then the degrees, as a square of x is in x^4; then
// how often anything is used.
struct Size {
  std::size_t ops = 0, degrees = 0, uses = 0;
  friend auto operator<=>(const Size&, const Size&) = default;
};

template <class Visit>
void for_each_computed(const Program& program, Visit visit) {
  const auto live = live_nodes(program);
  const auto region = regions(program);
  for (std::uint32_t i = 0; i < live.size(); ++i)
    if (live[i] && region[i] != Region::constant()) visit(program.graph[Id{i}]);
}

Size size_of(const Program& program) {
  const Graph& graph = program.graph;
  Size size;
  for_each_computed(reduce_powers(program),
                    [&](const Node& node) { size.ops += info(node.op).kind != OpKind::structure; });
  for_each_computed(program, [&](const Node& node) {
    if (node.op == Op::powi) size.degrees += static_cast<std::size_t>(std::abs(*graph.number(node.args[1])));
    size.uses += static_cast<std::size_t>(
        std::ranges::count_if(node.args, [&](Id arg) { return graph[arg].op != Op::constant; }));
  });
  return size;
}

}  // namespace

// Again and again, as what two sums have become may be a common factor.
Program horner(const Program& program) {
  Program result = program;
  for (Size size = size_of(result);;) {
    Program next = rewrite(result, Horner(result));
    const Size smaller = size_of(next);
    if (!(smaller < size)) return result;
    result = std::move(next);
    size = smaller;
  }
}

}  // namespace imp
