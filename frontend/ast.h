// The syntax tree, flat: an expression is a contiguous range of nodes, operands before what uses
// them. Lowering is then a loop over the range and a stack of values, however deep the text nests.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ir/op.h"
#include "ir/span.h"

namespace imp::syntax {

enum class NodeKind : std::uint8_t {
  number,   // as it stands at the span
  integer,  // `index` itself: a default that nobody wrote
  pi,
  input,       // `index` among the inputs of a surface: x, y, z, the parameters, the time
  definition,  // the value of definition `index`
  local,       // a parameter or an index: `index` within the bindings of the function
  op,          // `op` over the topmost values, as many as it takes
  swap,        // exchanges the two topmost values: a > b is b < a
  power,       // the topmost value is the exponent
  chebyshev,   // T(n, e): the degree below the argument
  call,        // function `index` over the topmost values
  series,      // sum or product by `op`: the first and the last value of a new local are on top,
               // the body follows, up to node `index`, and is replayed for each
};

struct Node {
  NodeKind kind = NodeKind::integer;
  Op op = Op::constant;
  std::uint32_t index = 0;
  std::uint32_t begin = 0, end = 0;  // bytes of the text
};
static_assert(sizeof(Node) == 16);

struct Range {
  std::uint32_t begin = 0, end = 0;  // of nodes

  std::uint32_t size() const { return end - begin; }
};

struct Definition {
  std::string_view name;
  std::uint32_t arity = 0;  // 0: a value
  Range body;
  Span span;  // of the name
};

struct Equation {
  std::string name;
  Range left, right;  // right is empty where there is no "="
  Span span;
};

// A number outside the surfaces, to be an output of Model::settings.
struct Number {
  std::string name;
  Range value;
  bool constant = false;  // neither parameter nor time may be in it
};

struct Ast {
  std::uint32_t file = 0;
  std::vector<Node> nodes;
  std::vector<Definition> definitions;
  std::vector<Equation> surfaces;
  std::vector<Number> settings;

  Span span(const Node& node) const { return {file, node.begin, node.end}; }
};

}  // namespace imp::syntax
