// The Taylor form of order 2. With r the distances from the middle c of the box:
//
//   f(c) + [-1, 1] sum |f_i(c)| r_i + [0, 1] sum F_ii(X) r_i^2/2 + [-1, 1] sum_(i<k) |F_ik(X)| r_i r_k
#include "passes/extend/centred.h"
#include "passes/extend/forms.h"

namespace imp {

std::optional<std::vector<Interval>> taylor_form(const Program& f, const InputBox& box,
                                                 Diagnostics& diagnostics) {
  const std::size_t n = box.variables.size();
  const auto derivatives = derivatives_of(f, box.variables, 2, diagnostics);
  if (!derivatives) return std::nullopt;
  const Program &gradient = (*derivatives)[0], &second = (*derivatives)[1];
  const IntervalRules rules;
  const Centre centre = centre_of(box);
  const InputBox middle{centre.sides, {}, box.domain};
  const auto all = interval_form(f, box, diagnostics);
  const auto values = interval_form(f, middle, diagnostics);
  const auto slopes = interval_form(gradient, middle, diagnostics);
  const auto range_of_slopes = interval_form(gradient, box, diagnostics);
  const auto bends = interval_form(second, box, diagnostics);
  if (!all || !values || !slopes || !range_of_slopes || !bends) return std::nullopt;

  std::vector<Interval> result;
  for (std::size_t output = 0; output < f.outputs.size(); ++output) {
    Interval value = (*values)[output];
    Truth smooth = truth_of(*value.hi.graph, true);
    for (std::size_t i = 0; i < n; ++i) {
      const Interval& r = centre.radius[i];
      const Interval& slope = (*slopes)[output * n + i];
      value = rules.add(value, symmetric(rules.mul(magnitude_of(slope), r).hi));
      smooth = smooth && (*range_of_slopes)[output * n + i].continuous;
      for (std::size_t k = i; k < n; ++k) {
        const Interval& bend = (*bends)[(output * n + i) * n + k];
        const Interval area = rules.mul(r, centre.radius[k]);
        value =
            rules.add(value, i == k ? rules.mul(bend, one_sided(mul_up(area.hi, constant_like(area.hi, 0.5))))
                                    : symmetric(rules.mul(magnitude_of(bend), area).hi));
        smooth = smooth && !bend.empty;
      }
    }
    result.push_back(or_intervals((*all)[output], smooth, value));
  }
  return result;
}

}  // namespace imp
