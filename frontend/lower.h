// From the syntax tree to the graph: definitions put in place, functions and sums written out.
#pragma once

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "frontend/ast.h"
#include "frontend/rational.h"
#include "ir/diagnostics.h"
#include "ir/program.h"

namespace imp::syntax {

// How many nodes of the tree a whole file may make us visit: a few functions of functions can stand
// for more than any machine holds.
inline constexpr std::size_t most_operations = 1'000'000;

// Lowers expressions into one graph. The tree has passed all checks: names are known and no
// definition leads back to itself.
class Lowering {
 public:
  // `inputs` are those of a surface; what no expression uses may be invalid. `budget` counts down
  // from most_operations.
  Lowering(const Ast& ast, Graph& graph, std::vector<Id> inputs, std::size_t& budget,
           Diagnostics& diagnostics);

  // Nothing, and a diagnostic, where a degree, a bound or an exponent is none, or the budget is
  // spent; `place` is the text to blame if no call or sum is.
  std::optional<Id> operator()(Range expression, Span place);

 private:
  // A range that is being replayed.
  struct Frame {
    NodeKind kind = NodeKind::number;  // definition, call, series; or the expression itself
    std::uint32_t at = 0, end = 0;     // the next node, and the one behind the last
    std::uint32_t base = 0;            // where the bindings of the function begin in locals_
    std::uint32_t index = 0;           // the definition, or the beginning of the body of a series
    Span span{};

    // Of a series.
    Op op = Op::add;
    double local = 0, last = 0;
    Id total{};
  };

  bool step(const Node& node);
  void enter_definition(const Node& node);
  void enter_call(const Node& node);
  bool enter_series(const Node& node);
  void leave();
  void leave_series(Frame& frame);

  void number(const Node& node);
  bool power(const Node& node);
  bool chebyshev(const Node& node);

  Id constant(double value) { return graph_.constant(f64, value); }
  Id make(const Node& node, Op op, std::initializer_list<Id> args);
  Id pop();
  std::optional<double> integer(Id value);
  std::optional<double> pop_integer();
  bool fail(Span place, std::string message);
  bool too_large(Span place);

  const Ast& ast_;
  Graph& graph_;
  std::vector<Id> inputs_;
  std::size_t& budget_;
  Diagnostics& diagnostics_;
  std::string_view text_;

  Rationals rationals_;
  std::unordered_map<std::uint32_t, Id> definitions_;  // those already lowered
  std::vector<Frame> frames_;
  std::vector<Id> values_, locals_;
};

}  // namespace imp::syntax
