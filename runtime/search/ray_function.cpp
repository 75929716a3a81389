// The functions that a strategy is given, over a segment.
#include "runtime/search/segment.h"

#include <memory>

#include "ir/assert.h"
#include "passes/along_ray.h"
#include "passes/differentiate.h"
#include "passes/economize.h"
#include "passes/extend/interval.h"
#include "passes/inline.h"
#include "passes/polynomial/bernstein.h"
#include "passes/polynomial/degree.h"
#include "passes/precision.h"
#include "passes/surface_passes.h"

namespace imp {
namespace {

// f and df/ds along rays, before they are placed in a kernel.
struct AlongRay {
  Program in_space;  // f64, exact constants, in x, y, z
  Program f, slope;  // without poles, f64, exact constants: to be enclosed
  Program near_f;    // enclosed for f over pieces: within `error` of it, where the ray is in its space
  double error = 0;
  std::optional<Program> poles;      // 0 where they are
  Program f_rounded, slope_rounded;  // in the kernel's type: to be evaluated
  Program f_in_double;
  std::vector<Range> domain;
  std::vector<Interval> bounds, wide_bounds;  // of o, d and the uniforms
  std::vector<Expr> values;
  const Inclusion* inclusion = nullptr;

  std::optional<Interval> try_to_enclose(const Program& g, const Interval& s,
                                         Diagnostics& diagnostics) const {
    constexpr std::size_t variable = 0;
    std::vector<Interval> sides{s};
    sides.insert(sides.end(), bounds.begin(), bounds.end());
    const auto result = inclusion->enclose(g, {sides, std::span(&variable, 1), domain}, diagnostics);
    if (!result) return std::nullopt;
    return result->front();
  }

  Interval enclose(const Program& g, const Interval& s) const {
    Diagnostics unused;
    const auto result = try_to_enclose(g, s, unused);
    IMP_ASSERT(result.has_value(), "a rule for every op, as tried before");
    return *result;
  }

  // What near_f lacks is defined and continuous everywhere.
  Interval enclose_f(const Interval& s) const {
    Interval result = enclose(near_f, s);
    if (error > 0) {
      const Expr off = rounded_up(*result.hi.graph, result.hi.type(), error);
      result.nlo = add_up(result.nlo, off), result.hi = add_up(result.hi, off);
      result.facts = {};
    }
    return broken_at_poles(result, s);
  }

  std::optional<RayDegree> degree(Diagnostics& diagnostics) const {
    constexpr std::size_t variables[] = {0, 1, 2};
    Diagnostics why;
    const auto result = degrees(in_space, variables, why);
    if (!result) {
      const Diagnostic& first = why.all().front();
      diagnostics.error(first.span, first.message + "; use --search=isolate or stackless");
      return std::nullopt;
    }
    return RayDegree{result->front().total, in_space.graph.span(in_space.outputs[0].id)};
  }

  std::optional<std::vector<Interval>> coefficients(const Interval& s, Diagnostics& diagnostics) const {
    constexpr std::size_t variable = 0;
    const auto& others = s.hi.type() == bounds[0].hi.type() ? bounds : wide_bounds;
    std::vector<Interval> sides{s};
    sides.insert(sides.end(), others.begin(), others.end());
    auto result = bernstein_by_products(f, {sides, std::span(&variable, 1), domain}, diagnostics);
    if (!result) return std::nullopt;
    return std::move(result->front().coefficients);
  }

  // Over a single place no form is tighter than the natural one.
  Interval enclose_at(Expr s) const {
    const Interval place = point(s, {.nonnegative = true, .bounded = true});
    return broken_at_poles(naturally(f, place), place);
  }

  Interval naturally(const Program& g, const Interval& s) const {
    const auto& others = s.hi.type() == bounds[0].hi.type() ? bounds : wide_bounds;
    std::vector<Interval> sides{s};
    sides.insert(sides.end(), others.begin(), others.end());
    Diagnostics unused;
    const auto result = imp::enclose(g, sides, unused, domain);
    IMP_ASSERT(result.has_value(), "a rule for every op, as tried before");
    return result->front();
  }

  Interval broken_at_poles(Interval value, const Interval& s) const {
    if (!poles) return value;
    const Interval divisor = naturally(*poles, s);
    value.continuous = value.continuous && divisor.continuous && !may_be_zero(divisor);
    return value;
  }

  Expr evaluate(const Program& g, Expr s) const {
    std::vector<Expr> inputs{s};
    inputs.insert(inputs.end(), values.begin(), values.end());
    return inline_program(g, inputs).front();
  }

  Expr evaluate_in_double(const Program& g, Expr s) const {
    std::vector<Expr> inputs{to(f64, s)};
    for (const Interval& each : wide_bounds) inputs.push_back(0.5 * (each.hi - each.nlo));
    return inline_program(g, inputs).front();
  }
};

Economized economized(const Program& f, const std::optional<SearchSpace>& space) {
  if (!space || !space->economize) return {f, 0};
  Economized result = economize(f, ranges_in(space->box, f), *space->economize);
  if (result.error > 0) result.f = simplified(result.f);
  return result;
}

std::optional<Program> slope_of(const Program& along, Diagnostics& diagnostics) {
  constexpr std::string_view s = "s";
  auto both = differentiate(along, std::span(&s, 1), diagnostics);
  if (!both) return std::nullopt;
  both->outputs.erase(both->outputs.begin());  // f itself
  return both;
}

}  // namespace

std::optional<RayFunction> ray_function(const Program& f, const Segment& segment,
                                        std::span<const Uniform> uniforms, const Inclusion& inclusion,
                                        const std::optional<SearchSpace>& space, Diagnostics& diagnostics) {
  const Expr like = segment.origin[0];
  const auto ray = std::make_shared<AlongRay>();
  ray->inclusion = &inclusion;
  ray->in_space = f;
  const Fraction parts = searched(f);
  ray->f = along_ray(parts.numerator);
  const Economized near = economized(parts.numerator, space);
  ray->near_f = along_ray(near.f);
  ray->error = near.error;
  if (parts.poles) ray->poles = along_ray(*parts.poles);
  auto slope = slope_of(ray->f, diagnostics);
  if (!slope) return std::nullopt;
  ray->slope = *std::move(slope);
  ray->f_rounded = in_precision(ray->f, like.type());
  ray->slope_rounded = in_precision(ray->slope, like.type());
  ray->f_in_double = in_precision(ray->f, f64);
  if (space) ray->domain = ranges_along_ray(space->box, f);

  for (const auto* bounds : {&segment.origin_bounds, &segment.direction_bounds})
    ray->bounds.insert(ray->bounds.end(), bounds->begin(), bounds->end());
  for (const auto* bounds : {&segment.wide_origin_bounds, &segment.wide_direction_bounds})
    ray->wide_bounds.insert(ray->wide_bounds.end(), bounds->begin(), bounds->end());
  for (const auto* values : {&segment.origin, &segment.direction})
    ray->values.insert(ray->values.end(), values->begin(), values->end());
  for (const Uniform& uniform : uniforms) {
    ray->bounds.push_back(uniform.bounds);
    ray->wide_bounds.push_back(uniform.wide_bounds);
    ray->values.push_back(uniform.value);
  }

  // Tried here once, so that the functions below cannot fail.
  const Interval start = point(zero(like));
  if (!ray->try_to_enclose(ray->f, start, diagnostics) ||
      !ray->try_to_enclose(ray->near_f, start, diagnostics) ||
      !ray->try_to_enclose(ray->slope, start, diagnostics))
    return std::nullopt;

  return RayFunction{
      .bound = [ray](const Interval& s) { return ray->enclose_f(s); },
      .slope_bound = [ray](const Interval& s) { return ray->enclose(ray->slope, s); },
      .bound_at = [ray](Expr s) { return ray->enclose_at(s); },
      .bound_in_double = [ray](Expr s) { return ray->enclose_at(to(f64, s)); },
      .value = [ray](Expr s) { return ray->evaluate(ray->f_rounded, s); },
      .slope = [ray](Expr s) { return ray->evaluate(ray->slope_rounded, s); },
      .value_in_double = [ray](Expr s) { return ray->evaluate_in_double(ray->f_in_double, s); },
      .like = like,
      .exists = segment.exists,
      .certain = space ? lies_in(segment, with_margin(space->box)) : truth_of(*like.graph, true),
      .degree = [ray](Diagnostics& d) { return ray->degree(d); },
      .coefficients = [ray](const Interval& s, Diagnostics& d) { return ray->coefficients(s, d); },
  };
}

}  // namespace imp
