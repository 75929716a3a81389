#include "passes/polynomial/blossom.h"

#include <algorithm>
#include <cmath>

#include "passes/polynomial/degree.h"
#include "passes/polynomial/power_basis.h"

namespace imp {
namespace {

constexpr std::size_t xyz[] = {0, 1, 2};

// The signs of s in the corners.
constexpr double corners[4][3] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};

using Barycentric = std::array<Interval, 4>;

Interval in_double(const Interval& a) {
  return {to(f64, a.nlo), to(f64, a.hi), a.empty, a.continuous, a.facts};
}

Interval in_type(const Interval& a, Type type) {
  const bool nonnegative = a.facts.nonnegative;
  return type == f64
             ? a
             : Interval{narrow_up(a.nlo), narrow_up(a.hi), a.empty, a.continuous, {nonnegative, false}};
}

// x = a + s (b_0 + b_1 - b_2 - b_3), and so on, where 1 is the sum of all b.
Substitution barycentric(const ControlNet& net, Expr like) {
  const IntervalRules rules;
  Substitution result;
  for (std::size_t i = 0; i < 4; ++i) result.unit.merge(variable(i, integer(like, 1)));
  for (const std::size_t axis : xyz) {
    Polynomial& place = result.places.emplace_back();
    const Interval centre = point(constant_like(like, net.centre[axis]));
    for (std::size_t i = 0; i < 4; ++i)
      place.merge(
          variable(i, rules.add(centre, point(constant_like(like, corners[i][axis] * net.size[axis])))));
  }
  return result;
}

Barycentric coordinates(const ControlNet& net, const SpacePoint& at) {
  const IntervalRules rules;
  const Expr like = at[0].hi;
  Barycentric result;
  for (std::size_t i = 0; i < 4; ++i) {
    Interval sum = integer(like, 1);
    for (const std::size_t axis : xyz) {
      const Interval shifted = rules.sub(at[axis], point(constant_like(like, net.centre[axis])));
      const Interval scaled = rules.div(shifted, point(constant_like(like, net.size[axis])));
      sum = corners[i][axis] > 0 ? rules.add(sum, scaled) : rules.sub(sum, scaled);
    }
    result[i] = rules.mul(sum, point(constant_like(like, 0.25)));
    result[i].nlo = min(zero(like), result[i].nlo);  // as the point lies in the tetrahedron
    result[i].facts = {true, at[0].facts.bounded && at[1].facts.bounded && at[2].facts.bounded};
  }
  return result;
}

// One step of de Casteljau's pyramid (eq. 1.8): of one degree less.
Polynomial step(const Polynomial& net, const Barycentric& at) {
  const IntervalRules rules;
  Polynomial result;
  for (const auto& [powers, value] : net)
    for (std::size_t i = 0; i < 4; ++i) {
      if (powers[i] == 0) continue;
      Powers below = powers;
      --below[i];
      const Interval term = rules.mul(at[i], value);
      const auto [it, fresh] = result.try_emplace(below, term);
      if (!fresh) it->second = rules.add(it->second, term);
    }
  return result;
}

}  // namespace

std::optional<ControlNet> control_net(const Program& f, const std::array<Range, 3>& box,
                                      std::span<const Interval> parameters, Expr like,
                                      Diagnostics& diagnostics) {
  ControlNet net;
  for (const std::size_t axis : xyz) {
    // As floats, so that they are numbers of either type.
    const double centre = static_cast<float>((box[axis].lo + box[axis].hi) / 2);
    const double radius =
        std::max({box[axis].hi - centre, centre - box[axis].lo, 1e-6 * std::abs(centre), 1e-30});
    net.centre[axis] = centre;
    net.size[axis] = static_cast<float>(3.25 * radius);
  }
  const auto degree = degrees(f, xyz, diagnostics);
  if (!degree) return std::nullopt;
  net.degree = (*degree)[0].total;

  const Expr wide{like.graph, like.graph->constant(f64, 0)};
  std::vector<Interval> sides(3, point(wide));
  for (const Interval& parameter : parameters) sides.push_back(in_double(parameter));
  const auto homogeneous = power_basis(f, {sides, xyz}, barycentric(net, wide), diagnostics);
  if (!homogeneous) return std::nullopt;
  for (const auto& [powers, value] : homogeneous->front())
    net.coefficients.emplace(
        powers, in_type(IntervalRules().div(value, integer(wide, multinomial(powers))), like.type()));
  return net;
}

std::vector<Interval> blossomed(const ControlNet& net, const SpacePoint& from, const SpacePoint& to) {
  const Barycentric near = coordinates(net, from), far = coordinates(net, to);
  std::vector<Interval> result(net.degree + 1, point(zero(from[0].hi), {true, true}));
  Polynomial remaining = net.coefficients;
  for (std::uint32_t k = net.degree;; --k) {  // near has been put in degree - k times
    Polynomial rest = remaining;
    for (std::uint32_t i = 0; i < k; ++i) rest = step(rest, far);
    if (!rest.empty()) result[k] = rest.begin()->second;
    if (k == 0) return result;
    remaining = step(remaining, near);
  }
}

}  // namespace imp
