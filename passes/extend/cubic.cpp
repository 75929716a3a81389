// The form of cubic convergence of Cornelius and Lohner (1984), as Hormann, Kania and Yap (2021) state it: the
// Taylor polynomial of degree 2 is a parabola, whose range is taken exactly; what remains is of third order.
//
//   f(c) + { sum g_i r_i + H_ii r_i^2/2 } + [-1, 1] sum_(i<k) |H_ik| R_i R_k
//        + [-1, 1] sum |F_ijk(X)| R_i R_j R_k/6        g, H: the derivatives in the middle c, |r_i| <= R_i
//
// Of one variable the order is 3. Of several it is 2, as the mixed terms are not taken exactly.

#include "ir/infinity.h"
#include "passes/extend/centred.h"
#include "passes/extend/forms.h"

namespace imp {
namespace {

// At least b r + k r^2 for all |r| <= R. The largest value lies at an end of [-R, R] unless the parabola is
// open downward and its vertex between them.
Expr parabola_up(const Interval& b, const Interval& k, Expr radius) {
  const Expr slope = magnitude_of(b).hi, half = mul_up(slope, constant_like(slope, 0.5));
  const Expr at_end = mul_up(add_up(slope, mul_up(k.hi, radius)), radius);
  const Expr at_vertex = div_up(mul_up(half, half), -k.hi);
  const Truth monotone =
      mul_up(mul_up(k.nlo, radius), constant_like(radius, 2)) <= IntervalRules().abs(b).lo();
  const Expr infinite = constant_like(radius, infinity);
  const Truth finite = add_up(add_up(slope, magnitude_of(k).hi), radius) < infinite;
  return select(finite, select(k.hi < 0 && !monotone, at_vertex, at_end), infinite);
}

Interval parabola(const Interval& b, const Interval& k, Expr radius) {
  const IntervalRules rules;
  return interval(parabola_up(rules.neg(b), rules.neg(k), radius), parabola_up(b, k, radius));
}

}  // namespace

std::optional<std::vector<Interval>> cubic_form(const Program& f, const InputBox& box,
                                                Diagnostics& diagnostics) {
  const std::size_t n = box.variables.size();
  const auto derivatives = derivatives_of(f, box.variables, 3, diagnostics);
  if (!derivatives) return std::nullopt;
  const Program &first = (*derivatives)[0], &second = (*derivatives)[1], &third = (*derivatives)[2];
  const IntervalRules rules;
  const Centre centre = centre_of(box);
  const InputBox middle{centre.sides, {}, box.domain};
  const auto all = interval_form(f, box, diagnostics);
  const auto values = interval_form(f, middle, diagnostics);
  const auto slopes = interval_form(first, middle, diagnostics);
  const auto bends = interval_form(second, middle, diagnostics);
  const auto range_of_slopes = interval_form(first, box, diagnostics);
  const auto range_of_bends = interval_form(second, box, diagnostics);
  const auto twists = interval_form(third, box, diagnostics);
  if (!all || !values || !slopes || !bends || !range_of_slopes || !range_of_bends || !twists)
    return std::nullopt;
  const auto scaled = [&](const Interval& a, double c) {
    return rules.mul(a, point(constant_like(a.hi, c)));
  };

  std::vector<Interval> result;
  for (std::size_t output = 0; output < f.outputs.size(); ++output) {
    Interval value = (*values)[output];
    Interval remainder = point(zero(value.hi), {true, true});
    Truth smooth = truth_of(*value.hi.graph, true);
    for (std::size_t i = 0; i < n; ++i) {
      const Interval& slope = (*slopes)[output * n + i];
      smooth = smooth && (*range_of_slopes)[output * n + i].continuous;
      for (std::size_t j = i; j < n; ++j) {
        const std::size_t ij = (output * n + i) * n + j;
        const Interval& bend = (*bends)[ij];
        const Interval area = rules.mul(centre.radius[i], centre.radius[j]);
        value = rules.add(value, i == j ? parabola(slope, scaled(bend, 0.5), centre.radius[i].hi)
                                        : symmetric(rules.mul(magnitude_of(bend), area).hi));
        smooth = smooth && (*range_of_bends)[ij].continuous;
        for (std::size_t k = 0; k < n; ++k) {
          const Interval& twist = (*twists)[ij * n + k];
          const Interval volume = rules.mul(area, centre.radius[k]);
          remainder = rules.add(remainder, scaled(rules.mul(magnitude_of(twist), volume), i == j ? 1 : 2));
          smooth = smooth && !twist.empty;
        }
      }
    }
    const Interval sixth = rules.div(remainder, point(constant_like(value.hi, 6)));
    result.push_back(or_intervals((*all)[output], smooth, rules.add(value, symmetric(sixth.hi))));
  }
  return result;
}

}  // namespace imp
