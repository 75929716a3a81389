// The mean value form. The middle of the box is nearly as far from both of its ends, so one radius serves for
// both: f(c) + [-1, 1] sum |F'_i(X)| r_i.
#include "passes/extend/centred.h"
#include "passes/extend/forms.h"
#include "passes/extend/interval.h"

namespace imp {
namespace {

// Whether no branch that may be taken is empty. An interval takes the hull of what the branches hold, but of
// a branch without a derivative there the mean value theorem asks for one: 0/0 at the root of what is 0.
Truth no_branch_is_missing(const Program& f, const InputBox& box) {
  const auto values = enclose_nodes(f, box.sides, box.domain);
  Truth result = truth_of(*box.sides[0].hi.graph, true);
  for (std::uint32_t i = 0; i < values.size(); ++i) {
    const Node& node = f.graph[Id{i}];
    if (node.op != Op::select || !node.type.is_real() || !values[i]) continue;
    const Possible& c = values[node.args[0].index]->truth;
    const Interval &a = values[node.args[1].index]->number, &b = values[node.args[2].index]->number;
    result = result && !(c.yes && a.empty) && !(c.no && b.empty);
  }
  return result;
}

}  // namespace

std::optional<std::vector<Interval>> mean_value_form(const Program& f, const InputBox& box,
                                                     Diagnostics& diagnostics) {
  const auto gradient = slopes_of(f, box.variables, diagnostics);
  if (!gradient) return std::nullopt;
  const IntervalRules rules;
  const Centre centre = centre_of(box);
  const auto all = interval_form(f, box, diagnostics);
  const auto middle = interval_form(f, {centre.sides, {}, box.domain}, diagnostics);
  const auto slopes = interval_form(*gradient, box, diagnostics);
  if (!all || !middle || !slopes) return std::nullopt;

  const Truth complete = no_branch_is_missing(*gradient, box);
  std::vector<Interval> result;
  for (std::size_t i = 0; i < f.outputs.size(); ++i) {
    Interval value = (*middle)[i];
    Truth smooth = complete;
    for (std::size_t k = 0; k < box.variables.size(); ++k) {
      const Interval& slope = (*slopes)[i * box.variables.size() + k];
      const Interval reach = rules.mul(magnitude_of(slope), centre.radius[k]);
      value = rules.add(value, symmetric(reach.hi));
      smooth = smooth && !slope.empty;
    }
    result.push_back(or_intervals((*all)[i], smooth, value));
  }
  return result;
}

}  // namespace imp
