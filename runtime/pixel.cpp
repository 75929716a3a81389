#include "runtime/pixel.h"

#include <algorithm>

#include <fmt/format.h>

#include "ir/infinity.h"
#include "ir/loop.h"
#include "passes/specialize.h"
#include "passes/surface_passes.h"
#include "runtime/beam.h"
#include "runtime/camera.h"
#include "runtime/search/parts/proven.h"
#include "runtime/search/parts/refine.h"
#include "runtime/search/segment.h"
#include "runtime/shade/phong.h"
#include "runtime/view.h"

namespace imp {
namespace {

constexpr Material material{.front = {0.80, 0.52, 0.17}, .back = {0.16, 0.34, 0.62}};
constexpr std::array undecided_mark{1.0, 0.0, 0.8};

// Composing more takes seconds, and no kernel could be made of it (runtime/kernel.h, far_too_long).
constexpr std::size_t most_nodes = 400'000;

// What a ray meets, with the normal there.
struct Sight {
  Expr verdict, steps;
  Truth something;
  Expr t;         // the distance from the origin of the ray, f32
  Expr begin;     // no root lies before it; infinite where there is none, -infinite where nothing is known
  Expr end;       // of a hit: its root does not lie behind it
  Vector normal;  // of length 1, f32; along the ray where f has no gradient
};

Vector to(Type type, const Vector& v) { return {to(type, v[0]), to(type, v[1]), to(type, v[2])}; }

class Pixel {
 public:
  Pixel(const Model& model, const RenderOptions& options, bool beams, Diagnostics& diagnostics)
      : model_(model),
        options_(options),
        beams_(beams),
        diagnostics_(diagnostics),
        type_(options.kernel.precision) {}

  std::optional<Program> build() {
    const Expr i = input("x0", f32, Rate::cell) + input("column", f32, Rate::ray) + 0.5;
    const Expr j = input("y0", f32, Rate::cell) + input("row", f32, Rate::ray) + 0.5;
    const CameraInputs camera = camera_inputs(program_);
    ray_ = is_orthographic(model_) ? orthographic_ray(camera, i, j) : perspective_ray(camera, i, j);
    clip_ = clip_to_domain();
    if (beams_) pad_ = input("pad.place", f32, Rate::frame);
    for (const std::string& name : uniform_names(model_))
      uniforms_.push_back(uniform(input(uniform_input(name), f64, Rate::frame), type_));

    const auto box = space_bounds(model_);
    if (box) space_ = SearchSpace{*box, options_.economize};
    if (!box && options_.economize) {
      diagnostics_.error("--economize needs a domain that does not depend on parameters or time");
      return std::nullopt;
    }

    std::optional<Sight> first;
    const auto drawn = drawn_surfaces(model_, options_);
    for (std::size_t k = 0; k < drawn.size(); ++k) {
      const auto sight = look_at(drawn[k], k);
      if (!sight) return std::nullopt;
      if (program_.graph.size() > most_nodes) {
        diagnostics_.error(model_.surfaces[drawn[k]].span,
                           fmt::format("with this surface, number {} of {}, the picture takes too many "
                                       "operations; a shorter formula is needed, or fewer with --surface",
                                       k + 1, drawn.size()));
        return std::nullopt;
      }
      first = first ? nearer(*first, *sight) : *sight;
    }
    output_channels(*first);
    return std::move(program_);
  }

 private:
  Expr input(const std::string& name, Type type, Rate rate) {
    return {&program_.graph, add_input(program_, name, type, rate)};
  }

  Vector vector_input(const std::string& name) {
    return {input(name + ".x", f32, Rate::frame), input(name + ".y", f32, Rate::frame),
            input(name + ".z", f32, Rate::frame)};
  }

  Clip clip_to_domain() {
    if (has_sphere_domain(model_)) {
      const Vector center = vector_input("domain.center");
      return clip_to_sphere(ray_, center, input("domain.radius", f32, Rate::frame));
    }
    const Vector min = vector_input("domain.min");
    return clip_to_box(ray_, min, vector_input("domain.max"));
  }

  // The piece of the ray on which a surface is searched, and whether all is found but the place.
  struct Piece {
    Expr near, far;
    Truth crosses;
    Expr sign;  // at near, where it crosses
  };

  Segment segment_of(Expr near, Expr far) const {
    return segment_of_numbers(to(type_, ray_.origin), to(type_, ray_.direction), to(type_, near),
                              to(type_, far));
  }

  // Its places with all that the rounding of any other segment of the same ray may make of them: what is proven here
  // holds there.
  Segment padded(Segment segment) {
    const Expr pad = 2.0 * to(type_, pad_);
    for (std::size_t i = 0; i < 3; ++i) {
      const Interval& place = segment.origin_bounds[i];
      segment.origin_bounds[i] = interval(add_up(place.nlo, pad), add_up(place.hi, pad));
    }
    return segment;
  }

  std::optional<RayFunction> along(const Program& f, const Segment& segment, const Inclusion& inclusion) {
    return ray_function(f, segment, uniforms_, inclusion, space_, diagnostics_);
  }

  std::optional<Piece> piece_for(const Program& f, std::size_t drawn, const Inclusion& inclusion) {
    const Piece all{clip_.near, clip_.far, truth_of(program_.graph, false), zero(clip_.near)};
    if (!beams_) return all;
    const Beam beam = beam_inputs(program_, drawn);
    const auto distance = [&](Expr depth) { return ray_.length * depth; };
    const Expr begin = distance(beam.near), end = distance(beam.run);
    const Expr near = max(clip_.near, begin), far = min(clip_.far, distance(beam.far));
    const Expr run = min(clip_.far, end);
    const Truth crosses = beam.crosses && clip_.near <= begin && end <= clip_.far;

    const auto in_run = along(f, padded(segment_of(near, run)), inclusion);
    if (!in_run) return std::nullopt;
    const auto [before, after] = signs_at_ends(*in_run, drawn, near < run && !crosses);
    const Truth same = before * after > 0, opposite = before * after < 0;
    return Piece{select(same, run, near), select(crosses || opposite, run, far), crosses || opposite,
                 select(crosses, beam.sign, to(f32, before))};
  }

  // At s = 0 and s = 1: proven, for those rays that want it; else 0.
  std::array<Expr, 2> signs_at_ends(const RayFunction& f, std::size_t drawn, Truth wanted) {
    Loop loop(program_, "ends" + std::to_string(drawn), 2);
    const Expr s = loop.state("s", zero(f.like));
    const Expr first = loop.state("first", zero(f.like));
    const Expr last = loop.state("last", zero(f.like));
    loop.next(s, one(f.like));
    loop.next(first, last);
    loop.next(last, proven_sign(f.bound_at(s)));
    loop.enter_if(wanted);
    loop.again_while(s < 1);
    return {loop.result(first), loop.result(last)};
  }

  // The strategy is for those rays on which the beam has not found all.
  std::optional<Found> find_behind_beam(RayFunction f, const Piece& piece, const Search& search) {
    f.exists = f.exists && !piece.crosses;
    auto found = search.build(program_, f, options_.limits, diagnostics_);
    if (!found) return std::nullopt;
    const auto instead = [&](Expr crossing, Expr otherwise) {
      return select(piece.crosses, crossing, otherwise);
    };
    Bracket& bracket = found->bracket;
    bracket = {instead(zero(f.like), bracket.a), instead(one(f.like), bracket.b),
               instead(to(type_, piece.sign), bracket.sign_a), piece.crosses || bracket.changes};
    found->verdict = instead(constant_like(f.like, verdict_hit), found->verdict);
    found->something = found->something || piece.crosses;
    return found;
  }

  std::optional<Sight> look_at(std::size_t surface, std::size_t drawn) {
    const auto searchable = searchable_function(model_, surface, options_.kernel, diagnostics_);
    if (!searchable) return std::nullopt;
    const Program& f = *searchable;
    const Method method = choose_method(f, options_.wish, options_.kernel);
    const auto whole = piece_for(f, drawn, *method.inclusion);
    if (!whole) return std::nullopt;
    const Piece& piece = *whole;
    const Segment segment = segment_of(piece.near, piece.far);
    const auto on_piece = along(f, segment, *method.inclusion);
    if (!on_piece) return std::nullopt;
    auto found = beams_ ? find_behind_beam(*on_piece, piece, *method.search)
                        : method.search->build(program_, *on_piece, options_.limits, diagnostics_);
    if (!found) return std::nullopt;
    // Beyond the domain what is drawn may be another function than f, and bounds do not hold.
    Truth certain = on_piece->certain;
    if (space_ && beams_)
      certain = certain && lies_in(segment_of(clip_.near, clip_.far), with_margin(space_->box));
    found->verdict = select(certain, found->verdict, constant_like(found->verdict, verdict_undecided));

    const Refined root = refine(program_, *on_piece, found->bracket);
    const Expr s = root.s;
    const auto unit = normal_at(f, segment, uniforms_, s, diagnostics_);
    if (!unit) return std::nullopt;
    Vector normal = to(f32, *unit);
    const Truth regular = dot(normal, normal) > 0.5;
    for (std::size_t i = 0; i < 3; ++i) normal[i] = select(regular, normal[i], -ray_.direction[i]);
    const Expr verdict = to(f32, verdict_with(root, found->verdict));
    const auto distance = [&](Expr share) { return piece.near + to(f32, share) * (piece.far - piece.near); };
    const Expr nowhere = constant_like(verdict, infinity);
    const Truth is_hit = equal(verdict, constant_like(verdict, verdict_hit));
    const Expr begin =
        select(found->something && certain, distance(select(is_hit, root.lo, found->bracket.a)),
               select(equal(verdict, constant_like(verdict, verdict_miss)), nowhere, -nowhere));
    return Sight{verdict, to(f32, found->steps), found->something, distance(s), begin, distance(root.hi),
                 normal};
  }

  // The first of two. A hit is certified if no root of the other surface can lie before it, by the brackets of both.
  Sight nearer(const Sight& a, const Sight& b) const {
    const auto place = [](const Sight& sight) {
      return select(sight.something, sight.t, constant_like(sight.t, infinity));
    };
    const Truth a_first = place(a) <= place(b);
    const auto pick = [&](Expr p, Expr q) { return select(a_first, p, q); };
    const Expr first = pick(a.verdict, b.verdict), other = pick(b.verdict, a.verdict);
    const Expr rounding = 0x1p-20 * clip_.far;
    const Truth misses = equal(other, constant_like(other, verdict_miss));
    const Truth certain = misses || pick(b.begin, a.begin) - pick(a.end, b.end) > rounding;
    Sight result;
    result.verdict = select(certain, first, constant_like(first, verdict_undecided));
    result.something = a.something || b.something;
    result.t = pick(a.t, b.t);
    result.begin = min(a.begin, b.begin);
    result.end = pick(a.end, b.end);
    result.steps = a.steps + b.steps;
    for (std::size_t i = 0; i < 3; ++i) result.normal[i] = pick(a.normal[i], b.normal[i]);
    return result;
  }

  Color shade(const Sight& sight, const Vector& place) {
    std::vector<LightInputs> lights;
    for (const bool directional : directional_lights(model_))
      lights.push_back(light_inputs(program_, lights.size(), directional));
    const Expr verdict = sight.verdict;
    const Color lit = phong(material, lights, place, sight.normal, ray_.direction);
    const Truth hit = verdict > 0, undecided = verdict < 0;

    Color color;
    for (std::size_t i = 0; i < 3; ++i) {
      const Expr nothing = constant_like(verdict, background[i]);
      Expr doubtful = nothing;
      if (options_.thin == Thin::draw) doubtful = select(sight.something, lit[i], nothing);
      if (options_.thin == Thin::mark) doubtful = constant_like(verdict, undecided_mark[i]);
      color[i] = select(hit, lit[i], select(undecided, doubtful, nothing));
    }
    return color;
  }

  void output_channels(const Sight& sight) {
    const Expr t = sight.t;
    const Color color = shade(sight, sum(ray_.origin, scaled(ray_.direction, t)));
    const auto output = [&](const char* name, Expr value) { program_.outputs.push_back({name, value.id}); };
    output("red", color[0]);
    output("green", color[1]);
    output("blue", color[2]);
    output("verdict", sight.verdict);
    const auto where_found = [&](Expr value, double otherwise) {
      return select(sight.something, value, constant_like(value, otherwise));
    };
    if (options_.depth) output("depth", where_found(t, infinity));
    if (options_.normal) {
      output("normal.x", where_found(sight.normal[0], 0));
      output("normal.y", where_found(sight.normal[1], 0));
      output("normal.z", where_found(sight.normal[2], 0));
    }
    if (options_.steps) output("steps", sight.steps);
    if (!options_.ray) return;
    constexpr const char* names[] = {"origin.x",    "origin.y",    "origin.z",
                                     "direction.x", "direction.y", "direction.z"};
    for (std::size_t i = 0; i < 3; ++i) output(names[i], ray_.origin[i]);
    for (std::size_t i = 0; i < 3; ++i) output(names[3 + i], ray_.direction[i]);
    output("near", clip_.near);
    output("far", clip_.far);
  }

  const Model& model_;
  const RenderOptions& options_;
  bool beams_;
  Diagnostics& diagnostics_;
  Type type_;
  Program program_{.name = "pixel"};
  PixelRay ray_;
  Clip clip_;
  Expr pad_;  // with beams: what the rounding of a place may be
  std::vector<Uniform> uniforms_;
  std::optional<SearchSpace> space_;
};

}  // namespace

Program over_domain(const Model& model, const Program& f) {
  const auto box = space_bounds(model);
  if (!box) return f;
  Program result = specialize(f, ranges_in(*box, f));
  return result == f ? f : result;  // numbered as it was
}

Program drawn_function(const Model& model, std::size_t surface) {
  return simplified(over_domain(model, model.surfaces[surface].f));
}

std::optional<Program> searchable_function(const Model& model, std::size_t surface,
                                           const KernelOptions& options, Diagnostics& diagnostics) {
  Program f = drawn_function(model, surface);
  const auto why = far_too_long_to_search(f, options);
  if (!why) return f;
  diagnostics.error(model.surfaces[surface].span, why->message);
  return std::nullopt;
}

std::vector<std::size_t> drawn_surfaces(const Model& model, const RenderOptions& options) {
  std::vector<std::size_t> drawn = options.surfaces;
  if (drawn.empty())
    for (std::size_t i = 0; i < model.surfaces.size(); ++i) drawn.push_back(i);
  return drawn;
}

std::optional<Program> pixel_program(const Model& model, const RenderOptions& options,
                                     Diagnostics& diagnostics, bool beams) {
  return Pixel(model, options, beams, diagnostics).build();
}

}  // namespace imp
