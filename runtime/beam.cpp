#include "runtime/beam.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "ir/loop.h"
#include "passes/differentiate.h"
#include "passes/extend/forms.h"
#include "passes/inline.h"
#include "passes/surface_passes.h"
#include "runtime/pixel.h"
#include "runtime/search/parts/proven.h"
#include "runtime/search/segment.h"
#include "runtime/view.h"

namespace imp {
namespace {

constexpr std::size_t most_surfaces = 64;  // beams of more take longer to compile than they save

constexpr std::uint32_t slabs = 16;
constexpr std::uint32_t cell_sides[] = {64, 16, beam_cell};  // of the cells of each stage, in pixels
constexpr double longest_direction = 16;  // that is expected; longer ones leave a beam unknown

// What a slab is to a surface, beside 1 and -1: excluded, and the sign of f. Outside of the domain it is empty.
constexpr double unknown = 0, monotone = 2, empty = 3;

std::string of_surface(const char* name, std::size_t index) { return name + std::to_string(index); }

Vector absolute(const Vector& v) { return {abs(v[0]), abs(v[1]), abs(v[2])}; }

// A piece of a beam: its points are middle + u across + v down + w along + [-slack, slack] in each coordinate, and
// the ways of its rays, by depth, way + u turn_across + v turn_down + [-bend, bend], for u, v, w in [-1, 1].
struct Slab {
  Vector middle, across, down, along, slack;
  Vector way, turn_across, turn_down, bend;
};

// The names of what a Slab holds, in the order of `components`.
constexpr const char* slab_names[] = {"middle", "across",      "down",      "along", "slack",
                                      "way",    "turn_across", "turn_down", "bend"};
constexpr std::size_t slack_component = 4, bend_component = 8;
std::array<Vector, 9> components(const Slab& s) {
  return {s.middle, s.across, s.down, s.along, s.slack, s.way, s.turn_across, s.turn_down, s.bend};
}

// f and its derivative by depth as functions of u, v, w and of the numbers of a Slab, then the uniforms of f. Of a
// fraction the numerator, and the poles as a third output. `slopes`: f and its gradient.
Program over_beam(const Fraction& fraction, const Program& slopes) {
  const Program& f = fraction.numerator;
  Program beam{.name = f.name};
  const auto input = [&](const std::string& name) {
    return Expr{&beam.graph, add_input(beam, name, f64, Rate::ray)};
  };
  const auto vector = [&](const std::string& name) {
    Vector v;
    for (std::size_t i = 0; i < 3; ++i) v[i] = input(name + "." + "xyz"[i]);
    return v;
  };
  const Expr u = input("u"), v = input("v"), w = input("w");
  std::array<Vector, 9> parts;
  for (std::size_t i = 0; i < parts.size(); ++i) parts[i] = vector(slab_names[i]);
  const auto& [middle, across, down, along, slack, way, turn_across, turn_down, bend] = parts;
  const Vector place =
      sum(sum(middle, slack), sum(sum(scaled(across, u), scaled(down, v)), scaled(along, w)));
  const Vector direction = sum(sum(way, bend), sum(scaled(turn_across, u), scaled(turn_down, v)));
  std::vector<Expr> inputs(place.begin(), place.end());
  for (std::size_t i = 3; i < f.inputs.size(); ++i) inputs.push_back(input(f.inputs[i].name));
  const auto values = inline_program(slopes, inputs);
  beam.outputs = {{"f", values[0].id}, {"slope", dot({values[1], values[2], values[3]}, direction).id}};
  if (fraction.poles) beam.outputs.push_back({"poles", inline_program(*fraction.poles, inputs).front().id});
  return beam;
}

// How far from its middle a slab goes in each coordinate, at most.
Vector radius_of(const Slab& s) {
  Vector radius;
  for (std::size_t i = 0; i < 3; ++i)
    radius[i] = add_up(add_up(abs(s.across[i]), abs(s.down[i])), add_up(abs(s.along[i]), s.slack[i]));
  return radius;
}

// Whether no point of a slab lies in the domain, nor close to it.
Truth is_outside(const Slab& s, const SpaceBounds& space) {
  Truth any = truth_of(*s.middle[0].graph, false);
  const Vector radius = radius_of(s);
  for (std::size_t i = 0; i < 3; ++i) {
    const double margin = 1e-3 * (space[i].hi - space[i].lo);
    const Truth beside = add_up(radius[i], s.middle[i]) < space[i].lo - margin ||
                         add_up(radius[i], -s.middle[i]) < -space[i].hi - margin;
    any = any || beside;
  }
  return any;
}

// What the inputs of over_beam are held in. A slab elsewhere is unknown.
struct Expected {
  std::vector<Range> ranges;
  SpaceBounds middle;
  double reach = 0;  // the longest side of the domain

  Expected(const SpaceBounds& space, std::size_t uniforms) {
    ranges.resize(3, {-1, 1});
    const auto add = [&](double lo, double hi) { ranges.push_back({lo, hi}); };
    for (const Range& side : space) reach = std::max(reach, side.hi - side.lo);
    for (std::size_t i = 0; i < 3; ++i) {
      middle[i] = {space[i].lo - reach, space[i].hi + reach};
      add(middle[i].lo, middle[i].hi);
    }
    for (int part = 0; part < 4 * 3; ++part) add(-reach, reach);
    for (int part = 0; part < 4 * 3; ++part) add(-longest_direction, longest_direction);
    ranges.resize(ranges.size() + uniforms, everything);
  }

  Truth hold(const Slab& s) const {
    Truth all = truth_of(*s.middle[0].graph, true);
    const auto require = [&](Truth holds) { all = all && holds; };
    const Vector radius = radius_of(s);
    const Vector length =
        sum(sum(absolute(s.way), s.bend), sum(absolute(s.turn_across), absolute(s.turn_down)));
    for (std::size_t i = 0; i < 3; ++i) {
      require(middle[i].lo <= s.middle[i] && s.middle[i] <= middle[i].hi);
      require(radius[i] <= reach);
      require(length[i] <= longest_direction);
    }
    return all;
  }
};

// A surface, ready to be enclosed.
struct Target {
  Program f;  // over_beam
  Expected expected;
  Form* form;
};

class Stages {
 public:
  Stages(const Model& model, const SpaceBounds& space) : model_(model), space_(space) {}

  bool add_target(const Program& f, Diagnostics& diagnostics) {
    const Fraction fraction = searched(f);
    const auto slopes = gradient(fraction.numerator, diagnostics);
    if (!slopes) return false;
    targets_.push_back(
        {over_beam(fraction, *slopes), {space_, f.inputs.size() - 3}, &affine_form_for(*slopes, space_)});
    return true;
  }

  std::optional<Pipeline> build(Diagnostics& diagnostics) {
    Pipeline stages;
    std::uint32_t parent = cell_sides[0];
    for (const std::uint32_t side : cell_sides) {
      auto cells = classes(side, diagnostics);
      if (!cells) return std::nullopt;
      stages.push_back({{parent / side, parent / side, slabs}, *std::move(cells)});
      parent = side;
    }
    stages.push_back({{1, 1, 1}, crossings()});
    return stages;
  }

 private:
  // Where the slabs of a cell lie: its depth from `near`, in steps.
  struct Depths {
    Expr near, step;
    Expr at(Expr k) const { return near + k * step; }
  };

  static Expr input(Program& program, const std::string& name, Rate rate) {
    return {&program.graph, add_input(program, name, f32, rate)};
  }
  static Expr table(Program& program, const std::string& name, std::uint32_t length = slabs) {
    return {&program.graph, add_input(program, name, table_of(f32, length), Rate::cell)};
  }
  static Expr entry(Expr table, Expr index) { return make(Op::load, table, index); }
  static Expr entry(Expr table, std::size_t index) {
    return entry(table, Expr{table.graph, table.graph->constant(f32, static_cast<double>(index))});
  }
  static void output(Program& program, const std::string& name, Expr value) {
    program.outputs.push_back({name, value.id});
  }

  // The slab between two depths of the beam of pixels [x, x + size] × [y, y + size].
  Slab slab(const CameraInputs& camera, Expr x, Expr y, double size, Expr near, Expr far, Expr pad_place,
            Expr pad_way) const {
    const double half = size / 2;
    const Expr z = 0.5 * (near + far);
    const Expr depth = 0.5 * add_up(far, -near);
    const Vector right = scaled(camera.right, constant_like(x, half)),
                 down = scaled(camera.down, constant_like(x, half));
    const Vector to_middle =
        sum(camera.corner, sum(scaled(camera.right, x + half), scaled(camera.down, y + half)));
    const Vector none{zero(x), zero(x), zero(x)}, place_pad{pad_place, pad_place, pad_place},
        way_pad{pad_way, pad_way, pad_way};
    if (is_orthographic(model_))
      return {sum(sum(camera.eye, to_middle), scaled(camera.forward, z)),
              right,
              down,
              scaled(camera.forward, depth),
              place_pad,
              camera.forward,
              none,
              none,
              way_pad};
    // z and u, v together: the product is bounded by its parts.
    Vector slack;
    for (std::size_t i = 0; i < 3; ++i)
      slack[i] = add_up(pad_place, mul_up(depth, add_up(abs(right[i]), abs(down[i]))));
    return {sum(camera.eye, scaled(to_middle, z)),
            scaled(right, z),
            scaled(down, z),
            scaled(to_middle, depth),
            slack,
            to_middle,
            right,
            down,
            way_pad};
  }

  // Of each target the class over a slab.
  std::optional<std::vector<Expr>> classify(Program& program, const Slab& s, Diagnostics& diagnostics) {
    static constexpr std::size_t variables[] = {0, 1, 2};
    const Expr unit = one(s.middle[0]);
    std::vector<Interval> sides(3, interval(unit, unit, {.bounded = true}));
    for (const Vector& part : components(s))
      for (const Expr value : part) sides.push_back(point(value));
    for (const std::size_t part : {slack_component, bend_component})
      for (std::size_t i = 0; i < 3; ++i) {
        const Expr value = components(s)[part][i];
        sides[3 + 3 * part + i] = interval(value, value);
      }
    const std::vector<std::string> names = uniform_names(model_);
    for (const std::string& name : names)
      sides.push_back(
          uniform(Expr{&program.graph, add_input(program, uniform_input(name), f64, Rate::frame)}, f32)
              .bounds);

    std::vector<Expr> result;
    for (const Target& target : targets_) {
      const auto bounds = target.form(target.f, {sides, variables, target.expected.ranges}, diagnostics);
      if (!bounds) return std::nullopt;
      const Interval &f = (*bounds)[0], &slope = (*bounds)[1];
      const auto number = [&](double value) { return constant_like(unit, value); };
      const Expr sign = proven_sign(f);
      Truth single = f.continuous && slope.continuous && abs(proven_sign(slope)) > 0;
      if (bounds->size() > 2) single = single && (*bounds)[2].continuous && !may_be_zero((*bounds)[2]);
      const Expr known =
          select(f.empty, number(empty),
                 select(abs(sign) > 0, sign, select(single, number(monotone), number(unknown))));
      result.push_back(select(is_outside(s, space_), number(empty),
                              select(target.expected.hold(s), known, number(unknown))));
    }
    return result;
  }

  // The classes of the slabs of a cell. The first stage cuts the whole domain; others what the parent does not
  // exclude for all targets, with the signs in front of that.
  std::optional<Program> classes(std::uint32_t side, Diagnostics& diagnostics) {
    const bool first = side == cell_sides[0];
    Program program{.name = "beam" + std::to_string(side)};
    const CameraInputs camera = camera_inputs(program);
    const Expr pad_place = input(program, "pad.place", Rate::frame),
               pad_way = input(program, "pad.way", Rate::frame);
    const Expr x0 = input(program, "x0", Rate::cell), y0 = input(program, "y0", Rate::cell);
    const Expr column = input(program, "column", Rate::ray), row = input(program, "row", Rate::ray),
               k = input(program, "slab", Rate::ray);
    Expr near = first ? input(program, "depth.near", Rate::frame) : entry(table(program, "near"), 0UL);
    Expr far = first ? input(program, "depth.far", Rate::frame) : entry(table(program, "far"), 0UL);
    std::vector<Expr> before(targets_.size(), zero(near));
    if (!first) {
      const Depths parent{near, (1.0 / slabs) * (far - near)};
      Expr begin = constant_like(near, slabs), end = zero(near);
      std::vector<Expr> tables;
      for (std::size_t t = 0; t < targets_.size(); ++t)
        tables.push_back(table(program, of_surface("class", t)));
      for (std::size_t i = 0; i < slabs; ++i)
        for (const Expr classes : tables) {
          const Truth left = !is_excluded(entry(classes, i));
          const Expr place = constant_like(near, static_cast<double>(i));
          begin = min(begin, select(left, place, constant_like(near, slabs)));
          end = max(end, select(left, place + 1.0, zero(near)));
        }
      for (std::size_t t = 0; t < targets_.size(); ++t)
        before[t] = select(begin > 0, sign_of(entry(tables[t], begin - 1.0)),
                           entry(table(program, of_surface("before", t)), 0UL));
      near = parent.at(begin);
      far = parent.at(end);
    }
    const double size = side;
    const Depths depths{near, (1.0 / slabs) * (far - near)};
    const auto result = classify(program,
                                 slab(camera, x0 + size * column, y0 + size * row, size, depths.at(k),
                                      depths.at(k + 1.0), pad_place, pad_way),
                                 diagnostics);
    if (!result) return std::nullopt;
    Truth needed = truth_of(program.graph, false);
    for (std::size_t t = 0; t < targets_.size(); ++t) {
      output(program, of_surface("class", t), (*result)[t]);
      output(program, of_surface("before", t), before[t]);
      const Truth left = !is_excluded((*result)[t]);
      needed = needed || left;
    }
    output(program, "near", near);
    output(program, "far", far);
    output(program, "needed", select(needed, one(near), zero(near)));
    return program;
  }

  static Truth is_excluded(Expr c) { return equal(abs(c), one(c)) || equal(c, constant_like(c, empty)); }
  static Expr sign_of(Expr c) { return select(equal(abs(c), one(c)), c, zero(c)); }

  // Reads the classes of a cell front to back.
  Program crossings() const {
    Program program{.name = "crossing"};
    const Expr first = entry(table(program, "near"), 0UL), last = entry(table(program, "far"), 0UL);
    const Depths depths{first, (1.0 / slabs) * (last - first)};
    Truth needed = truth_of(program.graph, false);
    for (std::size_t t = 0; t < targets_.size(); ++t) {
      const Expr classes = table(program, of_surface("class", t));
      Loop loop(program, of_surface("read", t), slabs);
      const Truth no = truth_of(program.graph, false);
      const Expr k = loop.state("k", zero(first));
      const Truth stopped = loop.state("stopped", no);
      const Truth crosses = loop.state("crosses", no);
      const Truth open = loop.state("open", no);  // in a monotone run
      const Expr run = loop.state("run", zero(first));
      const Expr before = loop.state("before", entry(table(program, of_surface("before", t)), 0UL));
      const Expr from = loop.state("from", constant_like(first, slabs));
      const Expr to = loop.state("to", zero(first));
      const Expr end = loop.state("end", zero(first));  // of the last run

      const Expr c = entry(classes, k), sign = sign_of(c);
      const Truth excluded = is_excluded(c), single = equal(c, constant_like(c, monotone));
      const Truth opens = single && !open;
      const Truth closed = open && excluded;
      const Truth change = closed && before * sign < 0, same = closed && before * sign > 0;
      const Truth stuck = (!excluded && !single) || (closed && !change && !same);
      const Expr next = k + 1.0;
      const Truth running = !stopped;
      loop.next(k, next);
      loop.next(open, select(running, opens || (open && !closed), open));
      loop.next(run, select(running && opens, k, run));
      loop.next(before, select(running && ((excluded && !open) || same), sign, before));
      loop.next(crosses, crosses || (running && change));
      loop.next(end, select(running && (change || stuck), k, end));
      loop.next(from, select(running && (change || stuck), select(open, run, k), from));
      loop.next(stopped, stopped || change || stuck);
      loop.next(to, select(!excluded, next, to));
      loop.again_while(next < slabs);

      // A run that no slab behind it ends.
      const Truth unfinished = !loop.result(stopped) && loop.result(open);
      const Expr begin = select(unfinished, loop.result(run), loop.result(from));
      const Expr stop = max(loop.result(to), begin);  // begin is the last of them where nothing is left
      const Truth left = begin < slabs;
      const Expr run_end = select(unfinished, constant_like(first, slabs), max(loop.result(end), begin));
      output(program, of_surface("near", t), depths.at(begin));
      output(program, of_surface("far", t), depths.at(stop));
      output(program, of_surface("run", t), depths.at(run_end));
      output(program, of_surface("sign", t), loop.result(before));
      output(program, of_surface("crosses", t), select(loop.result(crosses), one(first), zero(first)));
      needed = needed || left;
    }
    output(program, "needed", select(needed, one(first), zero(first)));
    return program;
  }

  const Model& model_;
  SpaceBounds space_;
  std::vector<Target> targets_;
};

}  // namespace

std::optional<Pipeline> beam_stages(const Model& model, const RenderOptions& options,
                                    Diagnostics& diagnostics) {
  const auto space = space_bounds(model);
  if (!space || options.kernel.backend == Backend::glsl) return Pipeline{};  // forms make a shader too long
  Stages stages(model, *space);
  const std::vector<std::size_t> drawn = drawn_surfaces(model, options);
  if (drawn.size() > most_surfaces) return Pipeline{};
  for (const std::size_t index : drawn) {
    const auto f = searchable_function(model, index, options.kernel, diagnostics);
    if (!f || !stages.add_target(*f, diagnostics)) return std::nullopt;
  }
  return stages.build(diagnostics);
}

Beam beam_inputs(Program& program, std::size_t index) {
  const auto number = [&](const char* name) {
    const Expr table{&program.graph,
                     add_input(program, of_surface(name, index), table_of(f32, 1), Rate::cell)};
    return make(Op::load, table, Expr{&program.graph, program.graph.constant(f32, 0)});
  };
  const Expr near = number("near"), far = number("far");
  return {near, far, number("run"), number("crosses") > 0, number("sign")};
}

}  // namespace imp
