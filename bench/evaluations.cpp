// What one evaluation costs, in cycles a lane: a value, a gradient, enclosures. Each stands in a loop in a
// kernel, at a place that moves from step to step, and no step waits for the one before. The time of the same
// loop around the coordinate x is taken off. Beside them what hand-written code took.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "backends/llvm/target.h"
#include "bench/by_hand.h"
#include "bench/clocks.h"
#include "bench/peak.h"
#include "bench/surfaces.h"
#include "bench/tables.h"
#include "ir/loop.h"
#include "passes/along_ray.h"
#include "passes/differentiate.h"
#include "passes/extend/forms.h"
#include "passes/inline.h"
#include "passes/precision.h"
#include "passes/surface_passes.h"
#include "runtime/kernel.h"

namespace imp::bench {
namespace {

constexpr std::size_t rays = 1 << 10;
constexpr std::uint32_t steps = 64;
constexpr int rounds = 9;

using Values = std::optional<std::vector<Expr>>;

// The ray of a lane, and how far along it the step at hand is; and the parameters of f.
struct Place {
  std::array<Expr, 3> origin, direction;
  Expr s;
  std::vector<Expr> uniforms;

  Expr on_axis(std::size_t i) const { return origin[i] + s * direction[i]; }
};

constexpr double piece = 0x1p-6;  // of the ray

Interval piece_at(Expr s) { return interval(-s, s + piece); }

Values value(const Program& f, const Place& at) {
  std::vector<Expr> inputs{at.s};
  inputs.insert(inputs.end(), at.origin.begin(), at.origin.end());
  inputs.insert(inputs.end(), at.direction.begin(), at.direction.end());
  inputs.insert(inputs.end(), at.uniforms.begin(), at.uniforms.end());
  return inline_program(in_precision(along_ray(f), f32), inputs);
}

Values gradient_value(const Program& f, const Place& at) {
  Diagnostics unused;
  const auto slopes = gradient(f, unused);
  if (!slopes) return std::nullopt;
  std::vector<Expr> inputs;
  for (std::size_t i = 0; i < 3; ++i) inputs.push_back(at.on_axis(i));
  inputs.insert(inputs.end(), at.uniforms.begin(), at.uniforms.end());
  return inline_program(in_precision(*slopes, f32), inputs);
}

Values bounds(const std::optional<std::vector<Interval>>& enclosures) {
  if (!enclosures) return std::nullopt;
  std::vector<Expr> ends;
  for (const Interval& each : *enclosures) ends.insert(ends.end(), {each.nlo, each.hi});
  return ends;
}

// Where rays and boxes lie; parameters may be anything.
std::vector<Range> around(std::size_t places, const Place& at) {
  std::vector<Range> domain(places, Range{-16, 16});
  domain.resize(places + at.uniforms.size(), everything);
  return domain;
}

Values along(const Program& g, Form* form, const Place& at) {
  constexpr std::size_t variable = 0;
  std::vector<Interval> sides{piece_at(at.s)};
  for (const Expr o : at.origin) sides.push_back(point(o));
  for (const Expr d : at.direction) sides.push_back(point(d));
  for (const Expr u : at.uniforms) sides.push_back(point(u));
  const std::vector<Range> domain = around(7, at);
  Diagnostics unused;
  return bounds(form(g, {sides, std::span(&variable, 1), domain}, unused));
}

template <Form* form>
Values form_along(const Program& f, const Place& at) {
  return along(along_ray(f), form, at);
}

// f and df/ds, which share what they have in common.
Values with_slope(const Program& f, const Place& at) {
  constexpr std::string_view s = "s";
  Diagnostics unused;
  const auto both = differentiate(along_ray(f), std::span(&s, 1), unused);
  return both ? along(*both, interval_form, at) : std::nullopt;
}

template <Form* form>
Values form_in_box(const Program& f, const Place& at) {
  constexpr std::size_t variables[] = {0, 1, 2};
  std::vector<Interval> sides;
  for (std::size_t i = 0; i < 3; ++i) sides.push_back(piece_at(at.on_axis(i)));
  for (const Expr u : at.uniforms) sides.push_back(point(u));
  const std::vector<Range> domain = around(3, at);
  Diagnostics unused;
  return bounds(form(f, {sides, variables, domain}, unused));
}

struct Column {
  std::string_view name;
  Values (*evaluate)(const Program& f, const Place& at);
  std::optional<Evaluation> by_hand;
  bool rounds = true;  // there is something to round outward
};

constexpr Column columns[] = {
    {"value", value, Evaluation::value, false},
    {"gradient", gradient_value, Evaluation::gradient, false},
    {"IA", form_along<&interval_form>, Evaluation::interval},
    {"AF1(1)", form_along<&affine_form>, Evaluation::affine_1},
    {"AF1(3)", form_in_box<&affine_form>, Evaluation::affine_3},
    {"f and df/ds by IA", with_slope, Evaluation::with_slope},
    {"Bernstein", form_along<&bernstein_form>, {}},
};

std::unique_ptr<Kernel> kernel_of(const Program& f, const Column& column, const KernelOptions& options) {
  Program program{.name = "evaluations"};
  const auto input = [&](const char* name) {
    return Expr{&program.graph, add_input(program, name, f32, Rate::ray)};
  };
  Place at;
  for (std::size_t i = 0; i < 3; ++i) at.origin[i] = input(std::array{"ox", "oy", "oz"}[i]);
  for (std::size_t i = 0; i < 3; ++i) at.direction[i] = input(std::array{"dx", "dy", "dz"}[i]);
  for (std::size_t i = 3; i < f.inputs.size(); ++i)
    at.uniforms.push_back({&program.graph, add_input(program, f.inputs[i].name, f32, Rate::frame)});
  Loop loop(program, "steps", steps);
  at.s = loop.state("s", zero(at.origin[0]));
  const Expr sum = loop.state("sum", zero(at.s));
  const auto values = column.evaluate(f, at);
  if (!values) return nullptr;
  Expr total = sum;
  for (const Expr each : *values) total = total + each;
  loop.next(at.s, at.s + piece);
  loop.next(sum, total);
  loop.again_while(at.s < 2);
  program.outputs.push_back({"sum", loop.result(sum).id});
  auto kernel = make_kernel(std::move(program), options);
  return kernel ? *std::move(kernel) : nullptr;
}

// What kernels run on: the rays, and the values of the parameters of f.
class Inputs {
 public:
  explicit Inputs(std::span<const double> uniforms) : columns_(6), result_(rays) {
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t k = 0; k < rays; ++k)
        columns_[i].push_back((i < 3 ? 1.0f : -0.5f) * std::sin(static_cast<float>(k * (i + 1))));
    for (const double value : uniforms) columns_.push_back({static_cast<float>(value)});
  }

  // Nanoseconds a lane and step.
  double time(const Kernel& kernel) {
    std::vector<const void*> in;
    for (std::size_t i = 0; i < kernel.program().inputs.size(); ++i) in.push_back(columns_[i].data());
    void* out[] = {result_.data()};
    const ThreadClock clock;
    kernel.run({rays, in, out});
    return clock.milliseconds() * 1e6 / (rays * steps);
  }

 private:
  std::vector<std::vector<float>> columns_;
  std::vector<float> result_;
};

// As far as the peak of multiply-adds tells: two of the widest registers a cycle.
double cycles_a_nanosecond() { return peak_gflops() / peak_a_cycle(); }

Program coordinate() {
  Program x{.name = "x"};
  for (const char* name : {"x", "y", "z"}) add_input(x, name, f64, Rate::ray);
  x.outputs.push_back({"f", x.inputs[0].id});
  return x;
}

// Kernels of f and of x, which are timed in turns.
struct Pair {
  std::unique_ptr<Kernel> of_f, of_x;

  Pair(const Program& f, const Column& column, const KernelOptions& options)
      : of_f(kernel_of(f, column, options)), of_x(kernel_of(coordinate(), column, options)) {}
  double cycles(Inputs& inputs, double cycles_a_nanosecond) const {
    return (inputs.time(*of_f) - inputs.time(*of_x)) * cycles_a_nanosecond;
  }
};

struct Cost {
  double outward, nearest, price;  // cycles a lane, and outward / nearest; medians
};

std::optional<Cost> cost(const Program& f, const Column& column, const std::string& target, Inputs& inputs) {
  const Pair outward(f, column, {.target = target});
  if (!outward.of_f) return std::nullopt;
  const Pair nearest(f, column, {.target = target, .outward = false});
  std::vector<double> sound, plain, price;
  for (int i = 0; i < rounds; ++i) {
    const double unit = cycles_a_nanosecond();
    plain.push_back(nearest.cycles(inputs, unit));
    sound.push_back(outward.cycles(inputs, unit));
    price.push_back(sound.back() / plain.back());
  }
  return Cost{median(sound), median(plain), median(price)};
}

using Costs = std::array<std::optional<Cost>, std::size(columns)>;

void print_head() {
  fmt::print("| surface |");
  for (const Column& column : columns) fmt::print(" {} |", column.name);
  fmt::print("\n| --- |");
  for ([[maybe_unused]] const Column& column : columns) fmt::print(" ---: |");
  fmt::print("\n");
}

// "12.3 (1.05)": outward, and by what it takes to nearest.
void print_row(const std::string& name, const Costs& costs) {
  fmt::print("| {} |", name);
  for (std::size_t i = 0; i < costs.size(); ++i)
    if (!costs[i])
      fmt::print(" - |");
    else if (columns[i].rounds)
      fmt::print(" {:.1f} ({:.2f}) |", costs[i]->outward, costs[i]->price);
    else
      fmt::print(" {:.2f} |", costs[i]->outward);
  fmt::print("\n");
  std::fflush(stdout);
}

// A lane of a shorter register takes more of its cycles.
void print_beside(const ByHand& by_hand, const Costs& costs, double lanes) {
  fmt::print("| {} |", by_hand.surface);
  for (std::size_t i = 0; i < costs.size(); ++i)
    if (costs[i] && columns[i].by_hand)
      fmt::print(" {:.2f} |", costs[i]->nearest / (by_hand.evaluation(*columns[i].by_hand) * 16 / lanes));
    else
      fmt::print(" - |");
  fmt::print("\n");
}

}  // namespace

void print_evaluations_table() {
  fmt::print("Cycles a lane, floats, outward, medians of {}; in brackets by those of rounding to nearest\n",
             rounds);
  for (const CpuTarget& target : cpu_targets()) {
    if (!target.runs_here || target.name == "host") continue;
    if (!only.target.empty() && target.name != only.target) continue;
    fmt::print("\n{}\n\n", target.name);
    print_head();
    std::vector<std::pair<std::string, Costs>> measured;
    for (const std::string& name : example_names()) {
      if (only.skips(name)) continue;
      const Model model = example(name);
      const Program f = simplified(model.surfaces[0].f);
      Diagnostics diagnostics;
      Inputs inputs(uniform_values(model, {}, {}, diagnostics).value());
      Costs costs;
      for (std::size_t i = 0; i < costs.size(); ++i) costs[i] = cost(f, columns[i], target.name, inputs);
      print_row(name, costs);
      measured.emplace_back(name, costs);
    }
    const unsigned lanes = target.register_bits / 32;
    fmt::print("\nTo nearest, by what hand-written code took times {}\n\n", 16 / lanes);
    print_head();
    for (const auto& [name, costs] : measured)
      if (const ByHand* known = by_hand(name)) print_beside(*known, costs, lanes);
  }
}

}  // namespace imp::bench
