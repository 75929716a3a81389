#include "passes/specialize.h"

#include "ir/assert.h"
#include "passes/extend/interval.h"
#include "passes/rewrite.h"

namespace imp {
namespace {

// What is known of a number over the domain. The ends of what is never defined mean nothing.
struct Bounds {
  double lo, hi;
  bool defined;  // everywhere
};

class Specialization {
 public:
  Specialization(const Program& f, std::span<const Range> domain) : old_(f.graph) {
    IMP_ASSERT(domain.size() == f.inputs.size(), "a range of every input");
    std::vector<Interval> sides;
    for (const Range& range : domain)
      sides.push_back(interval(rounded_up(scratch_, f64, -range.lo), rounded_up(scratch_, f64, range.hi),
                               {range.lo >= 0, false}));
    if (!sides.empty()) values_ = enclose_nodes(f, sides);
    values_.resize(f.graph.size());
  }

  Id operator()(Graph& graph, Id old, const Node& node) const {
    if (node.op != Op::input && values_[old.index]) {
      const auto decided =
          node.type.is_truth() ? decided_truth(graph, old) : decided_number(graph, old, node);
      if (decided) return *decided;
    }
    return copy(graph, node);
  }

 private:
  Bounds known(Id id) const {
    const Interval& number = values_[id.index]->number;
    const auto nlo = scratch_.number(number.nlo.id), hi = scratch_.number(number.hi.id);
    IMP_ASSERT(nlo && hi, "bounds that fold at a constant box");
    return {-*nlo, *hi, scratch_.truth_value(number.continuous.id) == true};
  }

  std::optional<Id> decided_truth(Graph& graph, Id old) const {
    const Possible& truth = values_[old.index]->truth;
    if (scratch_.truth_value(truth.no.id) == false) return graph.constant(true);
    if (scratch_.truth_value(truth.yes.id) == false) return graph.constant(false);
    return std::nullopt;
  }

  std::optional<Id> decided_number(Graph& graph, Id old, const Node& node) const {
    const Bounds value = known(old);
    if (node.op != Op::constant && value.defined && value.lo == value.hi)
      return graph.constant(node.type, value.lo + 0.0);  // not -0
    switch (node.op) {
      case Op::abs: {
        const Bounds a = operand(old, 0);
        if (a.lo >= 0) return node.args[0];
        if (a.hi <= 0) return graph.add(Op::neg, {node.args[0]});
        return std::nullopt;
      }
      case Op::max: return winner(node, operand(old, 0), operand(old, 1));
      case Op::min: return winner(node, turned(operand(old, 0)), turned(operand(old, 1)));
      default:      return std::nullopt;
    }
  }

  // The larger one. Where the first is undefined the answer is the second (ir/ops.def), and where the second is,
  // there is none: the second may be taken whatever is undefined, the first only where nothing is.
  static std::optional<Id> winner(const Node& node, Bounds a, Bounds b) {
    if (b.lo >= a.hi) return node.args[1];
    if (a.lo >= b.hi && a.defined && b.defined) return node.args[0];
    return std::nullopt;
  }

  static Bounds turned(Bounds a) { return {-a.hi, -a.lo, a.defined}; }
  Bounds operand(Id old, std::size_t i) const { return known(old_[old].args[i]); }

  const Graph& old_;
  Graph scratch_;
  std::vector<std::optional<IntervalRules::Value>> values_;
};

}  // namespace

Program specialize(const Program& f, std::span<const Range> domain) {
  const Specialization specialization(f, domain);
  return rewrite(f, [&](Graph& graph, Id old, const Node& node) { return specialization(graph, old, node); });
}

}  // namespace imp
