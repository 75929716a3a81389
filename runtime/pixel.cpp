#include "runtime/pixel.h"

#include <algorithm>
#include <limits>

#include "passes/differentiate.h"
#include "passes/inline.h"
#include "passes/precision.h"
#include "runtime/camera.h"
#include "runtime/search/segment.h"
#include "runtime/shade/phong.h"
#include "runtime/view.h"

namespace imp {
namespace {

constexpr Material material{.front = {0.80, 0.52, 0.17}, .back = {0.16, 0.34, 0.62}};
constexpr std::array background{1.0, 1.0, 1.0};
constexpr std::array undecided_mark{1.0, 0.0, 0.8};

// What a ray meets, with the normal there.
struct Sight {
  Found found;
  Vector normal;  // of length 1, f32; along the ray where f has no gradient
};

Expr to(Type type, Expr value) {
  if (value.type() == type) return value;
  return type == f32 ? narrow(value) : widen(value);
}

Vector to(Type type, const Vector& v) { return {to(type, v[0]), to(type, v[1]), to(type, v[2])}; }

class Pixel {
 public:
  Pixel(const Model& model, const RenderOptions& options, Diagnostics& diagnostics)
      : model_(model), options_(options), diagnostics_(diagnostics), type_(options.kernel.precision) {}

  std::optional<Program> build() {
    const Expr i = input("x0", f32, Rate::cell) + input("column", f32, Rate::ray) + 0.5;
    const Expr j = input("y0", f32, Rate::cell) + input("row", f32, Rate::ray) + 0.5;
    const CameraInputs camera = camera_inputs(program_);
    ray_ = is_orthographic(model_) ? orthographic_ray(camera, i, j) : perspective_ray(camera, i, j);
    clip_ = clip_to_domain();
    segment_ = segment_of_numbers(to(type_, ray_.origin), to(type_, ray_.direction), to(type_, clip_.near),
                                  to(type_, clip_.far));
    for (const std::string& name : uniform_names(model_))
      uniforms_.push_back(uniform(input(uniform_input(name), f64, Rate::frame), type_));

    std::optional<Sight> first;
    for (const std::size_t index : chosen_surfaces()) {
      const auto sight = look_at(model_.surfaces[index].f);
      if (!sight) return std::nullopt;
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

  std::vector<std::size_t> chosen_surfaces() const {
    std::vector<std::size_t> chosen = options_.surfaces;
    if (chosen.empty())
      for (std::size_t i = 0; i < model_.surfaces.size(); ++i) chosen.push_back(i);
    return chosen;
  }

  Clip clip_to_domain() {
    if (has_sphere_domain(model_)) {
      const Vector center = vector_input("domain.center");
      return clip_to_sphere(ray_, center, input("domain.radius", f32, Rate::frame));
    }
    const Vector min = vector_input("domain.min");
    return clip_to_box(ray_, min, vector_input("domain.max"));
  }

  std::optional<Sight> look_at(const Program& f) {
    const auto along = ray_function(f, segment_, uniforms_, space_bounds(model_), diagnostics_);
    const auto slopes = gradient(f, diagnostics_);
    if (!along || !slopes) return std::nullopt;
    const Search& search = options_.search ? *options_.search : searches().front();
    const Found found = search.build(program_, *along, options_.limits);

    std::vector<Expr> place;
    for (std::size_t i = 0; i < 3; ++i) place.push_back(segment_.origin[i] + found.s * segment_.direction[i]);
    for (const Uniform& each : uniforms_) place.push_back(each.value);
    const auto values = inline_program(in_precision(*slopes, type_), place);
    Vector normal = to(f32, normalized({values[1], values[2], values[3]}));
    const Truth regular = dot(normal, normal) > 0.5;
    for (std::size_t i = 0; i < 3; ++i) normal[i] = select(regular, normal[i], -ray_.direction[i]);
    return Sight{found, normal};
  }

  // The first of two. A hit is certified if the other surface is certain to lie behind it.
  Sight nearer(const Sight& a, const Sight& b) const {
    const auto place = [](const Found& f) {
      return select(f.something, f.s, constant_like(f.s, std::numeric_limits<double>::infinity()));
    };
    const Truth a_first = place(a.found) <= place(b.found);
    const auto pick = [&](Expr p, Expr q) { return select(a_first, p, q); };
    const Expr first = pick(a.found.verdict, b.found.verdict), other = pick(b.found.verdict, a.found.verdict);
    const Expr gap = abs(place(a.found) - place(b.found));
    const double run = 2 * longest_run(epsilon_of(options_.limits, type_));
    const Truth other_seen = select(a_first, b.found.something, a.found.something);  // not given up before it
    const Truth certain = other >= verdict_miss || (other_seen && gap > run);
    Sight result;
    result.found.verdict = select(certain, first, constant_like(first, verdict_undecided));
    result.found.something = a.found.something || b.found.something;
    result.found.s = pick(a.found.s, b.found.s);
    result.found.steps = a.found.steps + b.found.steps;
    for (std::size_t i = 0; i < 3; ++i) result.normal[i] = pick(a.normal[i], b.normal[i]);
    return result;
  }

  Color shade(const Sight& sight, const Vector& place) {
    std::vector<LightInputs> lights;
    for (const bool directional : directional_lights(model_))
      lights.push_back(light_inputs(program_, lights.size(), directional));
    const Expr verdict = to(f32, sight.found.verdict);
    const Color lit = phong(material, lights, place, sight.normal, ray_.direction);
    const Truth hit = verdict > 0, undecided = verdict < 0;

    Color color;
    for (std::size_t i = 0; i < 3; ++i) {
      const Expr nothing = constant_like(verdict, background[i]);
      Expr doubtful = nothing;
      if (options_.thin == Thin::draw) doubtful = select(sight.found.something, lit[i], nothing);
      if (options_.thin == Thin::mark) doubtful = constant_like(verdict, undecided_mark[i]);
      color[i] = select(hit, lit[i], select(undecided, doubtful, nothing));
    }
    return color;
  }

  void output_channels(const Sight& sight) {
    const Expr s = to(f32, sight.found.s);
    const Expr t = clip_.near + s * (clip_.far - clip_.near);
    const Color color = shade(sight, sum(ray_.origin, scaled(ray_.direction, t)));
    const auto output = [&](const char* name, Expr value) { program_.outputs.push_back({name, value.id}); };
    output("red", color[0]);
    output("green", color[1]);
    output("blue", color[2]);
    output("verdict", to(f32, sight.found.verdict));
    const auto where_found = [&](Expr value, double otherwise) {
      return select(sight.found.something, value, constant_like(value, otherwise));
    };
    if (options_.depth) output("depth", where_found(t, std::numeric_limits<double>::infinity()));
    if (options_.normal) {
      output("normal.x", where_found(sight.normal[0], 0));
      output("normal.y", where_found(sight.normal[1], 0));
      output("normal.z", where_found(sight.normal[2], 0));
    }
    if (options_.steps) output("steps", to(f32, sight.found.steps));
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
  Diagnostics& diagnostics_;
  Type type_;
  Program program_{.name = "pixel"};
  PixelRay ray_;
  Clip clip_;
  Segment segment_;
  std::vector<Uniform> uniforms_;
};

}  // namespace

std::optional<Program> pixel_program(const Model& model, const RenderOptions& options,
                                     Diagnostics& diagnostics) {
  return Pixel(model, options, diagnostics).build();
}

}  // namespace imp
