#include "frontend/lower.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "frontend/decimal.h"
#include "ir/assert.h"

namespace imp::syntax {
namespace {

constexpr double largest_exponent = 1 << 20;  // of Op::powi
constexpr double largest_integer = 0x1p53;    // below it doubles count one by one

}  // namespace

Lowering::Lowering(const Ast& ast, Graph& graph, std::vector<Id> inputs, std::size_t& budget,
                   Diagnostics& diagnostics)
    : ast_(ast),
      graph_(graph),
      inputs_(std::move(inputs)),
      budget_(budget),
      diagnostics_(diagnostics),
      text_(diagnostics.sources.text(ast.file)),
      rationals_(graph) {}

std::optional<Id> Lowering::operator()(Range expression, Span place) {
  if (expression.size() > budget_ && !too_large(place)) return std::nullopt;
  frames_.assign(1, {.at = expression.begin, .end = expression.end, .span = place});
  values_.clear();
  locals_.clear();
  while (!frames_.empty()) {
    Frame& frame = frames_.back();
    if (frame.at == frame.end) {
      leave();
      continue;
    }
    const bool went_well = budget_ > 0 ? --budget_, step(ast_.nodes[frame.at++]) : too_large(place);
    if (!went_well) return std::nullopt;
  }
  IMP_ASSERT(values_.size() == 1, "one value of an expression");
  return values_.back();
}

bool Lowering::step(const Node& node) {
  switch (node.kind) {
    case NodeKind::number:  number(node); return true;
    case NodeKind::integer: values_.push_back(constant(node.index)); return true;
    case NodeKind::pi:
      values_.push_back(make(node, Op::mul, {constant(4), make(node, Op::atan, {constant(1)})}));
      return true;
    case NodeKind::input:      values_.push_back(inputs_[node.index]); return true;
    case NodeKind::local:      values_.push_back(locals_[frames_.back().base + node.index]); return true;
    case NodeKind::swap:       std::swap(values_.back(), values_[values_.size() - 2]); return true;
    case NodeKind::definition: enter_definition(node); return true;
    case NodeKind::call:       enter_call(node); return true;
    case NodeKind::series:     return enter_series(node);
    case NodeKind::power:      return power(node);
    case NodeKind::chebyshev:  return chebyshev(node);
    case NodeKind::op:         break;
  }
  const auto arity = static_cast<std::size_t>(info(node.op).arity);
  const Id value = graph_.add(node.op, std::span(values_).last(arity));
  graph_.set_span(value, ast_.span(node));
  values_.resize(values_.size() - arity);
  values_.push_back(value);
  return true;
}

void Lowering::enter_definition(const Node& node) {
  const auto known = definitions_.find(node.index);
  if (known != definitions_.end()) return values_.push_back(known->second);
  const Range body = ast_.definitions[node.index].body;
  const auto base = static_cast<std::uint32_t>(locals_.size());
  frames_.push_back({NodeKind::definition, body.begin, body.end, base, node.index, ast_.span(node)});
}

void Lowering::enter_call(const Node& node) {
  const Definition& function = ast_.definitions[node.index];
  const auto base = static_cast<std::uint32_t>(locals_.size());
  const auto arguments = values_.end() - function.arity;
  locals_.insert(locals_.end(), arguments, values_.end());
  values_.erase(arguments, values_.end());
  frames_.push_back(
      {NodeKind::call, function.body.begin, function.body.end, base, node.index, ast_.span(node)});
}

bool Lowering::enter_series(const Node& node) {
  const auto last = pop_integer(), first = pop_integer();
  const Span span = ast_.span(node);
  const bool sum = node.op == Op::add;
  if (!first || !last)
    return fail(span, fmt::format("the bounds of a {} must be constant integers", sum ? "sum" : "product"));

  Frame& frame = frames_.back();
  const std::uint32_t body = frame.at;
  const std::uint32_t base = frame.base;
  frame.at = node.index;
  if (*first > *last) {
    values_.push_back(constant(sum ? 0 : 1));
    return true;
  }
  if ((*last - *first + 1) * (node.index - body) > static_cast<double>(budget_)) return too_large(span);
  locals_.push_back(constant(*first));
  frames_.push_back({NodeKind::series, body, node.index, base, body, span, node.op, *first, *last, Id{}});
  return true;
}

void Lowering::leave() {
  Frame& frame = frames_.back();
  if (frame.kind == NodeKind::series) return leave_series(frame);
  if (frame.kind == NodeKind::definition) {
    const Id value = values_.back();
    definitions_.emplace(frame.index, value);
    if (!graph_[value].args.empty()) graph_.set_name(value, ast_.definitions[frame.index].name);
  }
  locals_.resize(frame.base);
  frames_.pop_back();
}

void Lowering::leave_series(Frame& frame) {
  const Id value = pop();
  frame.total = frame.total.valid() ? graph_.add(frame.op, {frame.total, value}) : value;
  graph_.set_span(frame.total, frame.span);
  if (frame.local == frame.last) {
    values_.push_back(frame.total);
    locals_.pop_back();
    frames_.pop_back();
  } else {
    locals_.back() = constant(++frame.local);
    frame.at = frame.index;
  }
}

void Lowering::number(const Node& node) {
  const auto decimal = parse_decimal(text_.substr(node.begin, node.end - node.begin));
  IMP_ASSERT(decimal.has_value(), "a number in range");
  const Id value = lower(*decimal, graph_);
  graph_.set_span(value, ast_.span(node));
  values_.push_back(value);
}

// The integer power where the exponent is a constant integer, else the real power.
bool Lowering::power(const Node& node) {
  const Id exponent = pop(), base = pop();
  const auto n = integer(exponent);
  if (n && std::abs(*n) > largest_exponent)
    return fail(ast_.span(node), fmt::format("the exponent {} is beyond {}", *n, largest_exponent));
  if (n)
    values_.push_back(make(node, Op::powi, {base, constant(*n)}));
  else
    values_.push_back(make(node, Op::pow, {base, exponent}));
  return true;
}

bool Lowering::chebyshev(const Node& node) {
  const Id x = pop();
  const auto n = pop_integer();
  if (!n || *n < 0 || *n > largest_exponent)
    return fail(ast_.span(node),
                fmt::format("the degree of 'T' must be a constant integer from 0 to {}", largest_exponent));

  values_.push_back(make(node, Op::chebyshev, {x, constant(*n), constant(0)}));
  return true;
}

Id Lowering::make(const Node& node, Op op, std::initializer_list<Id> args) {
  const Id value = graph_.add(op, args);
  graph_.set_span(value, ast_.span(node));
  return value;
}

Id Lowering::pop() {
  const Id value = values_.back();
  values_.pop_back();
  return value;
}

// Of an integer; beyond `largest_integer` it is a double near it.
std::optional<double> Lowering::integer(Id value) {
  const auto exact = rationals_(value);
  return exact && exact->get_den() == 1 ? std::optional(exact->get_d()) : std::nullopt;
}

std::optional<double> Lowering::pop_integer() {
  const auto value = integer(pop());
  return value && std::abs(*value) < largest_integer ? value : std::nullopt;
}

bool Lowering::fail(Span place, std::string message) {
  const bool known = std::ranges::any_of(
      diagnostics_.all(), [&](const Diagnostic& d) { return d.span == place && d.message == message; });
  if (!known) diagnostics_.error(place, std::move(message));
  return false;
}

bool Lowering::too_large(Span place) {
  const auto expands = [](const Frame& frame) {
    return frame.kind == NodeKind::call || frame.kind == NodeKind::series;
  };
  const auto outermost = std::ranges::find_if(frames_, expands);
  return fail(outermost == frames_.end() ? place : outermost->span,
              fmt::format("expands to more than {} operations", most_operations));
}

}  // namespace imp::syntax
