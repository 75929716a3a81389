#include "runtime/search/segment.h"

#include <cmath>
#include <limits>
#include <memory>

#include "ir/assert.h"
#include "passes/along_ray.h"
#include "passes/differentiate.h"
#include "passes/extend/interval.h"
#include "passes/inline.h"
#include "passes/precision.h"

namespace imp {
namespace {

Expr to_nearest(Expr value, Type type) { return type == f32 ? narrow(value) : value; }

Interval outward(const Interval& wide, Type type) {
  if (type != f32) return wide;
  Interval result = wide;
  result.nlo = narrow_up(wide.nlo);
  result.hi = narrow_up(wide.hi);
  return result;
}

Truth is_finite(Expr value) { return abs(value) < std::numeric_limits<double>::infinity(); }

// `a` where it was made of finite numbers. Of the others nothing is known, and nothing can be proven.
Interval where(Truth finite, const Interval& a) {
  const Expr all_reals = constant_like(a.hi, std::numeric_limits<double>::infinity());
  Interval result = a;
  result.nlo = select(finite, a.nlo, all_reals);
  result.hi = select(finite, a.hi, all_reals);
  return result;
}

// The ranges of the inputs of along_ray(f): s, o, d, uniforms. Both ends of the segment lie in
// `space`, and rounding may carry them a little beyond it.
std::vector<Range> ranges_along_ray(const SpaceBounds& space, std::size_t uniforms) {
  std::vector<Range> result{{0, 1}};
  for (const Range& axis : space) {
    const double margin = 1e-3 * (std::abs(axis.lo) + std::abs(axis.hi) + axis.hi - axis.lo);
    result.push_back({axis.lo - margin, axis.hi + margin});
  }
  for (const Range& axis : space) {
    const double width = 1.01 * (axis.hi - axis.lo) + 1e-3 * (std::abs(axis.lo) + std::abs(axis.hi));
    result.push_back({-width, width});
  }
  result.resize(result.size() + uniforms, everything);
  return result;
}

// f and df/ds along rays, before they are placed in a kernel.
struct AlongRay {
  Program f, slope;                  // f64, exact constants: to be enclosed
  Program f_rounded, slope_rounded;  // in the kernel's type: to be evaluated
  std::vector<Range> domain;
  std::vector<Interval> bounds;  // of o, d and the uniforms
  std::vector<Expr> values;

  Interval enclose_one(const Program& g, const Interval& s) const {
    std::vector<Interval> inputs{s};
    inputs.insert(inputs.end(), bounds.begin(), bounds.end());
    Diagnostics unused;
    const auto result = enclose(g, inputs, unused, domain);
    IMP_ASSERT(result.has_value(), "an interval rule for every op, as tried before");
    return result->front();
  }

  Expr evaluate(const Program& g, Expr s) const {
    std::vector<Expr> inputs{s};
    inputs.insert(inputs.end(), values.begin(), values.end());
    return inline_program(g, inputs).front();
  }
};

std::optional<Program> slope_of(const Program& along, Diagnostics& diagnostics) {
  constexpr std::string_view s = "s";
  auto both = differentiate(along, std::span(&s, 1), diagnostics);
  if (!both) return std::nullopt;
  both->outputs.erase(both->outputs.begin());  // f itself
  return both;
}

}  // namespace

Uniform uniform(Expr value, Type type) {
  return {where(is_finite(value), outward(point(value), type)), to_nearest(value, type)};
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
    segment.origin[i] = to_nearest(o[i] + tmin * d[i], type);
    segment.direction[i] = to_nearest((tmax - tmin) * d[i], type);
  }
  segment.exists = !(tmax < tmin);
  return segment;
}

Segment segment_of_numbers(const std::array<Expr, 3>& o, const std::array<Expr, 3>& d, Expr near, Expr far) {
  Segment segment;
  for (std::size_t i = 0; i < 3; ++i) {
    segment.origin[i] = o[i] + near * d[i];
    segment.direction[i] = (far - near) * d[i];
    segment.origin_bounds[i] = point(segment.origin[i]);
    segment.direction_bounds[i] = point(segment.direction[i]);
  }
  segment.exists = !(near >= far);  // NaN: nothing is known of it
  return segment;
}

std::optional<RayFunction> ray_function(const Program& f, const Segment& segment,
                                        std::span<const Uniform> uniforms,
                                        const std::optional<SpaceBounds>& space, Diagnostics& diagnostics) {
  const Expr like = segment.origin[0];
  const auto ray = std::make_shared<AlongRay>();
  ray->f = along_ray(f);
  auto slope = slope_of(ray->f, diagnostics);
  if (!slope) return std::nullopt;
  ray->slope = *std::move(slope);
  ray->f_rounded = in_precision(ray->f, like.type());
  ray->slope_rounded = in_precision(ray->slope, like.type());
  if (space) ray->domain = ranges_along_ray(*space, uniforms.size());

  for (const auto* bounds : {&segment.origin_bounds, &segment.direction_bounds})
    ray->bounds.insert(ray->bounds.end(), bounds->begin(), bounds->end());
  for (const auto* values : {&segment.origin, &segment.direction})
    ray->values.insert(ray->values.end(), values->begin(), values->end());
  for (const Uniform& uniform : uniforms) {
    ray->bounds.push_back(uniform.bounds);
    ray->values.push_back(uniform.value);
  }

  // Tried here once, so that the functions below cannot fail.
  std::vector<Interval> trial{point(zero(like))};
  trial.insert(trial.end(), ray->bounds.begin(), ray->bounds.end());
  if (!enclose(ray->f, trial, diagnostics) || !enclose(ray->slope, trial, diagnostics)) return std::nullopt;

  return RayFunction{
      .bound = [ray](const Interval& s) { return ray->enclose_one(ray->f, s); },
      .slope_bound = [ray](const Interval& s) { return ray->enclose_one(ray->slope, s); },
      .value = [ray](Expr s) { return ray->evaluate(ray->f_rounded, s); },
      .slope = [ray](Expr s) { return ray->evaluate(ray->slope_rounded, s); },
      .like = like,
      .exists = segment.exists,
  };
}

}  // namespace imp
