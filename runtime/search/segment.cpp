#include "runtime/search/segment.h"

#include "ir/infinity.h"
#include "passes/differentiate.h"
#include "passes/inline.h"
#include "passes/precision.h"
#include "runtime/camera.h"

namespace imp {
namespace {

Interval outward(const Interval& wide, Type type) {
  if (type != f32) return wide;
  Interval result = wide;
  result.nlo = narrow_up(wide.nlo);
  result.hi = narrow_up(wide.hi);
  return result;
}

Interval widened(const Interval& a) {
  Interval result = a;
  result.nlo = to(f64, a.nlo), result.hi = to(f64, a.hi);
  return result;
}

Truth is_finite(Expr value) { return abs(value) < infinity; }

// `a` where it was made of finite numbers. Of the others nothing is known, and nothing can be proven.
Interval where(Truth finite, const Interval& a) {
  const Expr all_reals = constant_like(a.hi, infinity);
  Interval result = a;
  result.nlo = select(finite, a.nlo, all_reals);
  result.hi = select(finite, a.hi, all_reals);
  return result;
}

}  // namespace

Uniform uniform(Expr value, Type type) {
  const Truth finite = is_finite(value);
  return {where(finite, outward(point(value), type)), where(finite, point(value)), to(type, value)};
}

Segment segment_of_ray(const std::array<Expr, 3>& o, const std::array<Expr, 3>& d, Expr tmin, Expr tmax,
                       Type type) {
  const IntervalRules rules;
  Truth finite = is_finite(tmin) && is_finite(tmax);
  for (std::size_t i = 0; i < 3; ++i) finite = finite && is_finite(o[i]) && is_finite(d[i]);

  Segment segment;
  for (std::size_t i = 0; i < 3; ++i) {
    const Interval near = rules.add(point(o[i]), rules.mul(point(tmin), point(d[i])));
    const Interval along = rules.mul(rules.sub(point(tmax), point(tmin)), point(d[i]));
    segment.origin_bounds[i] = where(finite, outward(near, type));
    segment.direction_bounds[i] = where(finite, outward(along, type));
    segment.wide_origin_bounds[i] = where(finite, near);
    segment.wide_direction_bounds[i] = where(finite, along);
    segment.origin[i] = to(type, o[i] + tmin * d[i]);
    segment.direction[i] = to(type, (tmax - tmin) * d[i]);
  }
  segment.exists = !(tmax < tmin);
  return segment;
}

Segment segment_of_numbers(const std::array<Expr, 3>& o, const std::array<Expr, 3>& d, Expr near, Expr far) {
  Segment segment;
  Truth finite = truth_of(*near.graph, true);
  for (std::size_t i = 0; i < 3; ++i) {
    segment.origin[i] = o[i] + near * d[i];
    segment.direction[i] = (far - near) * d[i];
    finite = finite && is_finite(segment.origin[i]) && is_finite(segment.direction[i]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    segment.origin_bounds[i] = where(finite, point(segment.origin[i]));
    segment.direction_bounds[i] = where(finite, point(segment.direction[i]));
    segment.wide_origin_bounds[i] = widened(segment.origin_bounds[i]);
    segment.wide_direction_bounds[i] = widened(segment.direction_bounds[i]);
  }
  segment.exists = !(near >= far);  // NaN: nothing is known of it
  return segment;
}

std::optional<std::array<Expr, 3>> normal_at(const Program& f, const Segment& segment,
                                             std::span<const Uniform> uniforms, Expr s,
                                             Diagnostics& diagnostics) {
  const auto slopes = gradient(f, diagnostics);
  if (!slopes) return std::nullopt;
  std::vector<Expr> place;
  for (std::size_t i = 0; i < 3; ++i) place.push_back(segment.origin[i] + s * segment.direction[i]);
  for (const Uniform& each : uniforms) place.push_back(each.value);
  const auto values = inline_program(in_precision(*slopes, s.type()), place);
  return normalized({values[1], values[2], values[3]});
}

}  // namespace imp
