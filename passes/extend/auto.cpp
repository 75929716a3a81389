// The form that needs no choice. A polynomial gets slopes, which cost it a few products; with Chebyshev
// polynomials in it, intervals, as their rule is tight and long. Any other f gets affine forms where that pays, and
// intervals elsewhere.
//
// What pays is tried on a few small boxes in the domain. A form costs about as much as an interval, and one instead of
// the other is worth it where f itself comes out narrower; then a sub-expression gets a form if its own is narrower
// than its interval, or is an operand of such a one and holds a tenth of its radius in symbols: where they hold less
// there is no dependence left to follow.
#include <algorithm>
#include <array>
#include <cmath>

#include "ir/meaning.h"
#include "passes/extend/affine_rules.h"
#include "passes/extend/forms.h"
#include "passes/extend/interval.h"
#include "passes/polynomial/degree.h"

namespace imp {
namespace {

constexpr std::uint32_t largest_degree = 64;  // beyond it slopes overflow, and are no tighter
constexpr std::size_t most_nodes = 256;       // beyond it the code of forms is long
constexpr double narrower = 0.9, much_narrower = 0.75, dependent = 0.1;
constexpr int boxes = 5;
constexpr double share = 0x1p-8;  // of the domain, the width of a box: a search spends its time on small ones

// What was seen of a node over the boxes.
struct Trial {
  double width = 0;       // of the form over that of the interval, at most 2
  double dependence = 0;  // of the radius of the form, what the symbols hold
  int count = 0;

  bool pays() const { return width < narrower * count; }
  bool depends() const { return count > 0 && dependence >= dependent * count; }
};

// A place in [0, 1] for input i of box k (Kronecker's sequence).
double place(std::size_t i, int k) {
  return std::fmod(0.5 + (k + 1) * std::sqrt(2.0 + 3.0 * static_cast<double>(i)), 1.0);
}

// The sides of box k.
std::vector<Range> sample(const Program& f, const InputBox& box, double part, int k) {
  std::vector<Range> sides;
  for (std::size_t i = 0; i < f.inputs.size(); ++i) {
    const Range range = i < box.domain.size() && box.domain[i].bounded_by(1e6) ? box.domain[i] : Range{-1, 1};
    const bool varies = std::ranges::find(box.variables, i) != box.variables.end();
    const double width = varies ? part * (range.hi - range.lo) : 0;
    const double lo = range.lo + place(i, k) * (range.hi - range.lo - width);
    sides.push_back({lo, lo + width});
  }
  return sides;
}

std::vector<Interval> constants(Graph& graph, const std::vector<Range>& sides, Type type) {
  std::vector<Interval> result;
  for (const Range& side : sides)
    result.push_back(interval(rounded_up(graph, type, -side.lo), rounded_up(graph, type, side.hi)));
  return result;
}

// The widths of a node over one box, as expressions to be evaluated.
struct Widths {
  Expr interval, form, error;
};

std::optional<Widths> widths(const std::optional<IntervalRules::Value>& range,
                             const std::optional<AffineRules::Value>& value) {
  if (!range || !value || !value->form) return std::nullopt;
  const Expr width = add_up(range->number.nlo, range->number.hi), radius = affine::radius(*value->form);
  return Widths{width, add_up(radius, radius), add_up(value->form->e.nlo, value->form->e.hi)};
}

// What the graph comes to, in doubles and whatever rounding, with these inputs: NaN for what is no number.
std::vector<double> estimates(const Graph& graph, std::span<const double> inputs = {}) {
  std::vector<double> values(graph.size(), std::nan(""));
  for (std::uint32_t i = 0; i < values.size(); ++i) {
    const Node& node = graph[Id{i}];
    const auto arg = [&](std::size_t k) { return k < node.args.size() ? values[node.args[k].index] : 0; };
    const OpKind kind = info(node.op).kind;
    if (node.op == Op::constant)
      values[i] = node.type.is_truth() ? double(node.payload != 0) : *graph.number(Id{i});
    else if (i < inputs.size())
      values[i] = inputs[i];
    else if (kind == OpKind::choice)
      values[i] = arg(0) != 0 ? arg(1) : arg(2);
    else if (kind == OpKind::compare)
      values[i] = meaning::truth<double>(node.op, arg(0), arg(1));
    else if (kind == OpKind::logic)
      values[i] = meaning::truth<bool>(node.op, arg(0) != 0, arg(1) != 0);
    else if (kind == OpKind::convert)
      values[i] = arg(0);
    else if (kind != OpKind::packet && kind != OpKind::structure)
      values[i] = meaning::real<double>(node.op, arg(0), arg(1), arg(2));
  }
  return values;
}

void observe(Trial& trial, double interval, double form, double error) {
  if (!std::isfinite(interval + form) || !(interval > 0 && form > 0)) return;
  trial.width += std::min(form / interval, 2.0);
  trial.dependence += 1 - error / form;
  ++trial.count;
}

std::vector<Trial> try_forms(const Program& f, const InputBox& box, Type type) {
  std::vector<Trial> trials(f.graph.size());
  for (int k = 0; k < boxes; ++k) {
    Graph scratch;
    const auto sides = constants(scratch, sample(f, box, share, k), type);
    const auto ranges = enclose_nodes(f, sides);
    const auto forms = affine_nodes(f, {sides, box.variables});
    std::vector<std::optional<Widths>> all(trials.size());
    for (std::uint32_t i = 0; i < all.size(); ++i)
      if (f.graph[Id{i}].type.is_real()) all[i] = widths(ranges[i], forms[i]);
    const auto numbers = estimates(scratch);
    const auto number = [&](Expr e) { return numbers[e.id.index]; };
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i]) observe(trials[i], number(all[i]->interval), number(all[i]->form), number(all[i]->error));
  }
  return trials;
}

// From the outputs to the inputs: users come before their operands.
std::vector<bool> nodes_with_forms(const Program& f, const std::vector<Trial>& trials) {
  std::vector<bool> wanted(trials.size());
  for (const Output& output : f.outputs) wanted[output.id.index] = trials[output.id.index].pays();
  for (std::size_t i = trials.size(); i-- > 0;)
    for (const Id arg : f.graph[Id{static_cast<std::uint32_t>(i)}].args)
      if (wanted[i] && trials[arg.index].depends()) wanted[arg.index] = true;
  return wanted;
}

// Of the outputs in two forms the width of one over that of the other: the mean over boxes where the first output may
// be 0, which are those that a search does not leave at once.
double mean_narrowing(const Program& f, std::span<const Range> domain, Form& inner_form, Form& outer_form) {
  constexpr std::size_t variables[] = {0, 1, 2};
  constexpr int many = 256;
  constexpr double tile_share = 0x1p-3;
  Program scratch;
  std::vector<Expr> ends;  // the first nodes of the graph
  for (std::size_t i = 0; i < 2 * f.inputs.size(); ++i)
    ends.emplace_back(&scratch.graph, add_input(scratch, "end" + std::to_string(i), f64, Rate::ray));
  std::vector<Interval> sides;
  for (std::size_t i = 0; i < ends.size(); i += 2) sides.push_back(interval(ends[i], ends[i + 1]));
  const InputBox box{sides, variables, domain};
  Diagnostics unused;
  const auto inner = inner_form(f, box, unused), outer = outer_form(f, box, unused);
  if (!inner || !outer) return 1;
  double sum = 0;
  int count = 0;
  for (int k = 0; k < many; ++k) {
    std::vector<double> inputs;
    for (const Range& side : sample(f, box, tile_share, k)) inputs.insert(inputs.end(), {-side.lo, side.hi});
    const auto numbers = estimates(scratch.graph, inputs);
    const auto number = [&](Expr e) { return numbers[e.id.index]; };
    const auto width = [&](const Interval& a) { return number(a.nlo) + number(a.hi); };
    if (!(number(outer->front().nlo) >= 0 && number(outer->front().hi) >= 0)) continue;
    for (std::size_t i = 0; i < outer->size(); ++i)
      if (const double ratio = width((*inner)[i]) / width((*outer)[i]); ratio >= 0) sum += ratio, ++count;
  }
  return count > 0 ? sum / count : 1;
}

bool is_low_polynomial(const Program& f, std::span<const std::size_t> variables) {
  Diagnostics unused;
  const auto all = degrees(f, variables, unused);
  return all &&
         std::ranges::all_of(*all, [](const Degree& degree) { return degree.total <= largest_degree; });
}

bool has_chebyshev(const Program& f) {
  for (std::uint32_t i = 0; i < f.graph.size(); ++i)
    if (f.graph[Id{i}].op == Op::chebyshev) return true;
  return false;
}

}  // namespace

std::optional<std::vector<Interval>> auto_form(const Program& f, const InputBox& box,
                                               Diagnostics& diagnostics) {
  if (has_chebyshev(f)) return interval_form(f, box, diagnostics);
  if (is_low_polynomial(f, box.variables)) return slope_form(f, box, diagnostics);
  if (f.graph.size() > most_nodes) return interval_form(f, box, diagnostics);
  const auto trials = try_forms(f, box, box.sides[0].hi.type());
  return enclosures(affine_values(f, box, diagnostics, {.forms = nodes_with_forms(f, trials)}));
}

Form& affine_form_for(const Program& f, std::span<const Range> domain) {
  std::vector<Range> ranges(domain.begin(), domain.end());
  ranges.resize(f.inputs.size(), everything);
  const double narrowing = mean_narrowing(f, ranges, affine_and_interval_form, affine_form);
  return narrowing < much_narrower ? affine_and_interval_form : affine_form;
}

}  // namespace imp
