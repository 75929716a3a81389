// What one evaluation costs, in cycles a lane: a value, a gradient, enclosures. Each stands in a loop in a
// kernel, at a place that moves from step to step, and no step waits for the one before. The time of the same
// loop around the coordinate x is taken off.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "backends/llvm/target.h"
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

// The ray of a lane, and how far along it the step at hand is.
struct Place {
  std::array<Expr, 3> origin, direction;
  Expr s;
};

constexpr double piece = 0x1p-6;  // of the ray

Interval piece_at(Expr s) { return interval(-s, s + piece); }

Values value(const Program& f, const Place& at) {
  std::vector<Expr> inputs{at.s};
  inputs.insert(inputs.end(), at.origin.begin(), at.origin.end());
  inputs.insert(inputs.end(), at.direction.begin(), at.direction.end());
  return inline_program(in_precision(along_ray(f), f32), inputs);
}

Values gradient_value(const Program& f, const Place& at) {
  Diagnostics unused;
  const auto slopes = gradient(f, unused);
  if (!slopes) return std::nullopt;
  std::vector<Expr> inputs;
  for (std::size_t i = 0; i < 3; ++i) inputs.push_back(at.origin[i] + at.s * at.direction[i]);
  return inline_program(in_precision(*slopes, f32), inputs);
}

Values bounds(const std::optional<std::vector<Interval>>& enclosures) {
  if (!enclosures) return std::nullopt;
  return std::vector{enclosures->front().nlo, enclosures->front().hi};
}

Values along(const Program& g, Form* form, const Place& at) {
  constexpr std::size_t variable = 0;
  std::vector<Interval> sides{piece_at(at.s)};
  for (const Expr o : at.origin) sides.push_back(point(o));
  for (const Expr d : at.direction) sides.push_back(point(d));
  const std::vector<Range> domain(7, Range{-16, 16});
  Diagnostics unused;
  return bounds(form(g, {sides, std::span(&variable, 1), domain}, unused));
}

template <Form* form>
Values form_along(const Program& f, const Place& at) {
  return along(along_ray(f), form, at);
}

Values slope_along(const Program& f, const Place& at) {
  constexpr std::string_view s = "s";
  Diagnostics unused;
  auto slope = differentiate(along_ray(f), std::span(&s, 1), unused);
  if (!slope) return std::nullopt;
  slope->outputs.erase(slope->outputs.begin());
  return along(*slope, interval_form, at);
}

template <Form* form>
Values form_in_box(const Program& f, const Place& at) {
  constexpr std::size_t variables[] = {0, 1, 2};
  std::vector<Interval> sides;
  for (std::size_t i = 0; i < 3; ++i) sides.push_back(piece_at(at.origin[i] + at.s * at.direction[i]));
  const std::vector<Range> domain(3, Range{-16, 16});
  Diagnostics unused;
  return bounds(form(f, {sides, variables, domain}, unused));
}

struct Column {
  std::string_view name;
  Values (*evaluate)(const Program& f, const Place& at);
  bool rounds = true;  // there is something to round outward
};

constexpr Column columns[] = {
    {"value", value, false},
    {"gradient", gradient_value, false},
    {"IA", form_along<&interval_form>},
    {"AF1, ray", form_along<&affine_form>},
    {"AF1, box", form_in_box<&affine_form>},
    {"df/ds by IA", slope_along},
    {"Bernstein", form_along<&bernstein_form>},
};

std::unique_ptr<Kernel> kernel_of(const Program& f, const Column& column, const KernelOptions& options) {
  Program program{.name = "evaluations"};
  const auto input = [&](const char* name) {
    return Expr{&program.graph, add_input(program, name, f32, Rate::ray)};
  };
  Place at;
  for (std::size_t i = 0; i < 3; ++i) at.origin[i] = input(std::array{"ox", "oy", "oz"}[i]);
  for (std::size_t i = 0; i < 3; ++i) at.direction[i] = input(std::array{"dx", "dy", "dz"}[i]);
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

class Rays {
 public:
  Rays() : result_(rays) {
    for (std::size_t i = 0; i < 6; ++i) {
      inputs_[i].resize(rays);
      for (std::size_t k = 0; k < rays; ++k)
        inputs_[i][k] = (i < 3 ? 1.0f : -0.5f) * std::sin(static_cast<float>(k * (i + 1)));
    }
  }

  // Nanoseconds a lane and step.
  double time(const Kernel& kernel) {
    std::array<const void*, 6> in;
    for (std::size_t i = 0; i < 6; ++i) in[i] = inputs_[i].data();
    void* out[] = {result_.data()};
    const ThreadClock clock;
    kernel.run({rays, in, out});
    return clock.milliseconds() * 1e6 / (rays * steps);
  }

 private:
  std::array<std::vector<float>, 6> inputs_;
  std::vector<float> result_;
};

// Cycles a nanosecond, as far as the peak of multiply-adds tells: two of the widest registers a cycle.
double cycles_a_nanosecond() { return peak_gflops() / (__builtin_cpu_supports("avx512f") != 0 ? 64 : 32); }

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
  double cycles(Rays& some, double cycles_a_nanosecond) const {
    return (some.time(*of_f) - some.time(*of_x)) * cycles_a_nanosecond;
  }
};

// "12.3 (1.05)": outward rounding, and how much more that takes than to nearest.
std::string cell(const Program& f, const Column& column, const std::string& target, Rays& some) {
  const Pair outward(f, column, {.target = target});
  if (!outward.of_f) return "-";
  std::optional<Pair> nearest;
  if (column.rounds) nearest.emplace(f, column, KernelOptions{.target = target, .outward = false});
  std::vector<double> cycles, ratios;
  for (int i = 0; i < rounds; ++i) {
    const double unit = cycles_a_nanosecond();
    cycles.push_back(outward.cycles(some, unit));
    if (nearest) ratios.push_back(cycles.back() / nearest->cycles(some, unit));
  }
  return nearest ? fmt::format("{:.1f} ({:.2f})", median(cycles), median(ratios))
                 : fmt::format("{:.2f}", median(cycles));
}

}  // namespace

void print_evaluations_table() {
  fmt::print("Cycles a lane, floats, medians of {}; in brackets by the cycles of rounding to nearest\n",
             rounds);
  Rays some;
  for (const CpuTarget& target : cpu_targets()) {
    if (!target.runs_here || target.name == "host") continue;
    if (!only.target.empty() && target.name != only.target) continue;
    fmt::print("\n{}\n\n| surface |", target.name);
    for (const Column& column : columns) fmt::print(" {} |", column.name);
    fmt::print("\n| --- |");
    for ([[maybe_unused]] const Column& column : columns) fmt::print(" ---: |");
    fmt::print("\n");
    for (const std::string& name : example_names()) {
      if (only.skips(name)) continue;
      const Program f = simplified(example(name).surfaces[0].f);
      if (f.inputs.size() != 3) continue;
      fmt::print("| {} |", name);
      for (const Column& column : columns) fmt::print(" {} |", cell(f, column, target.name, some));
      fmt::print("\n");
      std::fflush(stdout);
    }
  }
}

}  // namespace imp::bench
