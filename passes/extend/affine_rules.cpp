#include "passes/extend/affine_rules.h"

#include <algorithm>
#include <cmath>

#include "ir/assert.h"
#include "ir/infinity.h"
#include "passes/constants.h"
#include "passes/extend/forms.h"
#include "passes/extend/interval.h"
#include "passes/extend/over_box.h"

namespace imp {
namespace {

using Value = AffineRules::Value;

constexpr unsigned largest_power = 12;  // beyond it forms overflow before intervals do, and are no tighter

bool is_bounded(const Range& range, Type type) {
  return range.lo <= range.hi && range.bounded_by(affine::safe(type));
}
double farthest(const Range& range) { return std::max(std::abs(range.lo), std::abs(range.hi)); }

// The part of `a` where values can be.
Interval clipped(const Interval& a, const Range& known, Type type) {
  if (known.lo > known.hi) return a;
  Graph& graph = *a.hi.graph;
  Interval result = a;
  if (known.lo > -infinity) result.nlo = min(a.nlo, rounded_up(graph, type, -known.lo));
  if (known.hi < infinity) result.hi = min(a.hi, rounded_up(graph, type, known.hi));
  result.facts.nonnegative |= known.lo >= 0;
  return result;
}

struct Factor {
  double value;
  bool exact;
};

// A factor that does not change, as `scale` takes it.
std::optional<Factor> factor(const Affine& a) {
  const Graph& graph = *a.c.graph;
  const auto value = graph.number(a.c.id), error = graph.number(affine::larger(a.e).id);
  if (!value || !error || *value == 0 || !std::isfinite(*value)) return std::nullopt;
  for (const Expr x : a.x)
    if (graph.number(x.id) != 0.0) return std::nullopt;
  if (!(*error <= affine::eps(a.c.type()) * std::abs(*value))) return std::nullopt;
  return Factor{*value, *error == 0};
}

bool is_exact_zero(const Affine& a) {
  return a.limit < 1e-19 && a.c.graph->number(a.c.id) == 0.0 &&
         a.c.graph->number(affine::larger(a.e).id) == 0.0;
}

}  // namespace

AffineRules::AffineRules(const Program& f, const InputBox& box, AffineOptions options)
    : f_(f), box_(box), shape_{box.variables.size(), options.signed_errors}, options_(std::move(options)) {
  IMP_ASSERT(box.sides.size() == f.inputs.size() && !f.inputs.empty(), "an enclosure of every input");
  if (!box.domain.empty()) known_ = ranges(f, box.domain, box.sides[0].hi.type());
}

Value AffineRules::input(std::size_t i) const {
  const Interval& side = box_.sides[i];
  const Range known = box_.domain.empty() ? everything : box_.domain[i];
  const double limit = is_bounded(known, side.hi.type()) ? farthest(known) : infinity;
  const auto symbol = std::ranges::find(box_.variables, i);
  const auto index = static_cast<std::size_t>(symbol - box_.variables.begin());
  return {affine::of_interval(side, shape_,
                              symbol == box_.variables.end() ? std::nullopt : std::optional(index), limit),
          side, true};
}

Value AffineRules::truth(bool value) const {
  Graph& graph = *box_.sides[0].hi.graph;
  return Possible{truth_of(graph, value), truth_of(graph, !value)};
}

Value AffineRules::constant(const Enclosure& value) const {
  const Expr like = box_.sides[0].hi;
  const Interval range = constant_interval(*like.graph, like.type(), value);
  double nearest = like.type() == f32 ? static_cast<double>(value.nearest_float) : value.nearest;
  if (!(std::abs(value.lo) < affine::safe(like.type()) && std::abs(value.hi) < affine::safe(like.type())))
    return only(range);
  if (value.lo > value.hi) return {affine::constant(like, shape_, 0, 0), range, true};
  if (std::abs(nearest) < affine::smallest_normal(like.type())) nearest = 0;
  const double error = std::max(value.hi - nearest, nearest - value.lo);
  return {affine::constant(like, shape_, nearest, error * (1 + 0x1p-50)), range, true};
}

// What is made of the result of an op, without what is known of a node.
Value AffineRules::settled(Value value) const {
  const Type type = value.range.hi.type();
  const Interval ops = clipped(value.range, value.known, type);
  const bool known = imp::is_bounded(value.known, type);
  const auto interval_form = [&] {
    return affine::of_interval(ops, shape_, std::nullopt, known ? farthest(value.known) : infinity);
  };
  if (!value.form) {
    value.form = interval_form();
    value.range = ops;
    value.range.facts.bounded |= affine::is_bounded(*value.form);
    return value;
  }
  // A form far beyond all values is worth nothing: without it no part is ever infinite.
  if (const double enough = 4 * farthest(value.known) + 1e-20; known && !affine::is_bounded(*value.form)) {
    value.form->limit = infinity;
    value.form = affine::select(affine::magnitude(*value.form) < enough, *value.form, interval_form());
    value.form->limit = 2 * enough;
  }
  const affine::Ends ends = affine::ends(*value.form);
  Interval form = ops;
  form.nlo = ends.nlo, form.hi = ends.hi;
  if (affine::is_bounded(*value.form)) {
    form = clipped(form, value.known, type);
    form.facts = {value.known.lo >= 0 && value.known.lo <= value.known.hi, true};
    if (options_.intersect || value.narrowed) {
      form.nlo = imp::min(form.nlo, ops.nlo);
      form.hi = imp::min(form.hi, ops.hi);
      form.facts.nonnegative |= ops.facts.nonnegative;
    }
    value.range = form;
  } else {
    const Truth holds = affine::is_form(*value.form);
    value.range = ops;
    value.range.nlo = imp::select(holds, imp::min(form.nlo, ops.nlo), ops.nlo);
    value.range.hi = imp::select(holds, imp::min(form.hi, ops.hi), ops.hi);
  }
  return value;
}

Value AffineRules::finished(Id id, Value value) const {
  if (!known_.empty() && known_[id.index]) value.known = *known_[id.index];
  if (!options_.forms.empty() && !options_.forms[id.index]) value.form.reset();
  value = settled(std::move(value));
  value.range.hi.graph->set_span(value.range.hi.id, f_.graph.span(id));
  return value;
}

Value AffineRules::add(const Value& a, const Value& b) const {
  return {affine::add(*a.form, *b.form), rules_.add(a, b)};
}

Value AffineRules::sub(const Value& a, const Value& b) const {
  return {affine::sub(*a.form, *b.form), rules_.sub(a, b)};
}

Value AffineRules::neg(const Value& a) const { return {affine::neg(*a.form), rules_.neg(a)}; }

Value AffineRules::mul(const Value& a, const Value& b) const {
  const Interval range = rules_.mul(a, b);
  if (is_exact_zero(*a.form)) return {a.form, range};
  if (is_exact_zero(*b.form)) return {b.form, range};
  if (const auto c = factor(*b.form)) return {affine::scale(*a.form, c->value, c->exact), range};
  if (const auto c = factor(*a.form)) return {affine::scale(*b.form, c->value, c->exact), range};
  return {affine::mul(*a.form, *b.form), range};
}

Value AffineRules::square(const Value& a) const { return {affine::square(*a.form), rules_.square(a)}; }

Value AffineRules::fma(const Value& a, const Value& b, const Value& c) const {
  return add(settled(mul(a, b)), c);
}

Value AffineRules::div(const Value& a, const Value& b) const {
  const Interval range = rules_.div(a, b);
  if (const auto c = factor(*b.form)) {
    const Type type = a.range.hi.type();
    const double exact = 1 / c->value,
                 inverse = type == f32 ? static_cast<double>(static_cast<float>(exact)) : exact;
    // Beyond, it is off by more than roundings of a normal number.
    if (std::abs(inverse) >= affine::smallest_normal(type) && std::abs(inverse) < affine::safe(type))
      return {affine::scale(*a.form, inverse, c->exact && affine::is_power_of_two(c->value)), range};
  }
  const Affine inverse = reciprocal(b);
  if (const auto c = factor(*a.form)) return {affine::scale(inverse, c->value, c->exact), range};
  return {affine::mul(*a.form, inverse), range};
}

Affine AffineRules::power(const Affine& a, unsigned n) const {
  if (n == 1) return a;
  if (n % 2 == 0) return affine::square(power(a, n / 2));
  if (n % 3 == 0) return affine::cube(power(a, n / 3));
  return affine::mul(power(a, n - 1), a);
}

Value AffineRules::powi(const Value& a, const Value& exponent) const {
  const double n = a.range.hi.graph->number(exponent.range.hi.id).value_or(infinity);
  const Interval range = rules_.powi(a, exponent);
  if (n == 0) return {affine::constant(a.range.hi, shape_, 1, 0), range};
  if (std::abs(n) > largest_power) return only(range);
  const Affine positive = power(*a.form, static_cast<unsigned>(std::abs(n)));
  if (n > 0) return {positive, range, static_cast<int>(n) % 2 == 0};
  const Interval farthest = point(constant_like(a.range.hi, -n));
  return {reciprocal(settled({positive, rules_.powi(a, farthest)})), range};
}

Value AffineRules::mod(const Value& a, const Value& b) const {
  const Value whole = settled(floor(settled(div(a, b))));
  return {affine::sub(*a.form, *settled(mul(b, whole)).form), rules_.mod(a, b)};
}

// The form of the branch that is taken; where both may be, that of the interval.
Value AffineRules::select(const Value& c, const Value& a, const Value& b) const {
  const Interval range = rules_.select(c, a, b);
  const Affine either = affine::of_interval(range, shape_, std::nullopt, infinity);
  return {affine::select(!c.truth.no, *a.form, affine::select(!c.truth.yes, *b.form, either)), range};
}

std::vector<std::optional<Value>> affine_nodes(const Program& f, const InputBox& box) {
  return over_box(f, AffineRules(f, box));
}

std::optional<std::vector<Value>> affine_values(const Program& f, const InputBox& box,
                                                Diagnostics& diagnostics, AffineOptions options) {
  return outputs_of(f, over_box(f, AffineRules(f, box, std::move(options))), diagnostics);
}

std::optional<std::vector<Interval>> enclosures(const std::optional<std::vector<Value>>& values) {
  if (!values) return std::nullopt;
  std::vector<Interval> result(values->begin(), values->end());
  for (Interval& interval : result) interval.facts = {};
  return result;
}

std::optional<std::vector<Interval>> affine_form(const Program& f, const InputBox& box,
                                                 Diagnostics& diagnostics) {
  return enclosures(affine_values(f, box, diagnostics));
}

std::optional<std::vector<Interval>> affine_and_interval_form(const Program& f, const InputBox& box,
                                                              Diagnostics& diagnostics) {
  return enclosures(affine_values(f, box, diagnostics, {.intersect = true}));
}

std::optional<std::vector<Interval>> signed_affine_form(const Program& f, const InputBox& box,
                                                        Diagnostics& diagnostics) {
  return enclosures(affine_values(f, box, diagnostics, {.signed_errors = true}));
}

}  // namespace imp
