// The elementary functions as compiled Programs, a lane, beside SLEEF and libmvec: floats, AVX2, one
// thread, arguments where the functions are used.
#include <fmt/format.h>

#include <random>

#include "backends/llvm/target.h"
#include "bench/clocks.h"
#include "bench/rivals.h"
#include "bench/tables.h"
#include "ir/expr.h"
#include "passes/elementary/bounds.h"
#include "runtime/kernel.h"

namespace imp::bench {
namespace {

constexpr std::size_t count = 1 << 12;  // all in the first cache
constexpr int rounds = 41, repeats = 50;

struct Row {
  Op op;
  float from, to;
};

constexpr Row rows[] = {
    {Op::exp, -20, 20},  {Op::log, 0.01f, 100}, {Op::pow, 0.01f, 10}, {Op::cbrt, -100, 100},
    {Op::sin, -20, 20},  {Op::cos, -20, 20},    {Op::tan, -20, 20},   {Op::asin, -1, 1},
    {Op::acos, -1, 1},   {Op::atan, -10, 10},   {Op::atan2, -10, 10}, {Op::sinh, -10, 10},
    {Op::cosh, -10, 10}, {Op::tanh, -5, 5},     {Op::asinh, -10, 10}, {Op::acosh, 1, 10},
    {Op::atanh, -1, 1},
};

// The function alone, or with bounds that round upward, as in an enclosure.
std::unique_ptr<Kernel> kernel_of(std::span<const Op> ops, bool upward) {
  Program program{.name = "functions"};
  std::vector<Expr> args;
  for (const char* name : {"x", "y"})
    args.push_back({&program.graph, add_input(program, name, f32, Rate::ray)});
  for (const Op op : ops) {
    Expr value = info(op).arity == 1 ? make(op, args[0]) : make(op, args[0], args[1]);
    if (upward) value = elementary::above(op, value);
    program.outputs.push_back({std::string(info(op).name), value.id});
  }
  auto kernel = make_kernel(std::move(program), {.target = "avx2"});
  return kernel ? *std::move(kernel) : nullptr;
}

class Numbers {
 public:
  explicit Numbers(const Row& row) : x_(count), y_(count), results_{x_, x_} {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> between(row.from, row.to);
    for (float& x : x_) x = between(random);
    for (float& y : y_) y = between(random);
  }

  // Nanoseconds a lane.
  double time(const Kernel& kernel) {
    const void* inputs[] = {x_.data(), y_.data()};
    void* outputs[] = {results_[0].data(), results_[1].data()};
    const Batch batch{count, inputs, std::span(outputs).first(kernel.program().outputs.size())};
    return time([&] { kernel.run(batch); });
  }
  double time(ArrayFunction function) {
    return time([&] { function(count, x_.data(), y_.data(), results_[0].data()); });
  }
  double time_sleef_sincos() {
    return time([&] { sleef_sincos(count, x_.data(), results_[0].data(), results_[1].data()); });
  }

 private:
  template <class Work>
  double time(Work work) {
    const ThreadClock clock;
    for (int i = 0; i < repeats; ++i) work();
    return clock.milliseconds() * 1e6 / (repeats * count);
  }

  std::vector<float> x_, y_;
  std::vector<float> results_[2];
};

void print_row(const Row& row, std::string_view name, std::span<const Op> ops) {
  const auto nearest = kernel_of(ops, false), upward = kernel_of(ops, true);
  if (!nearest || !upward) return;
  Numbers numbers(row);
  std::vector<double> plain, bound, by_sleef, by_libmvec;
  for (int i = 0; i < rounds; ++i) {
    plain.push_back(numbers.time(*nearest));
    bound.push_back(numbers.time(*upward));
    double times[2] = {0, 0};
    for (const Op op : ops) {
      times[0] += numbers.time(sleef(op));
      times[1] += numbers.time(libmvec(op));
    }
    by_sleef.push_back(ops.size() == 1 ? times[0] : numbers.time_sleef_sincos());
    by_libmvec.push_back(times[1]);
  }
  fmt::print("| {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} |\n", name, median(plain), median(bound),
             median(by_sleef), median(by_libmvec), median(plain) / median(by_sleef));
  std::fflush(stdout);
}

}  // namespace

void print_elementary_table() {
  if (!cpu_target("avx2")->runs_here) return fmt::print("this processor has no AVX2\n");
  fmt::print(
      "Floats, 8 lanes (AVX2), one thread, ns a lane, medians of {} runs in turns. Errors: ours at most 2 "
      "ulps in any\n"
      "rounding (angles up to 12800), SLEEF u10 at most 1.0, libmvec at most 4, both to nearest only\n\n",
      rounds);
  fmt::print("| function | ours | an upper bound | SLEEF u10 | libmvec | ours / SLEEF |\n");
  fmt::print("| --- | ---: | ---: | ---: | ---: | ---: |\n");
  for (const Row& row : rows) print_row(row, info(row.op).name, std::span(&row.op, 1));
  const Op both[] = {Op::sin, Op::cos};
  print_row({Op::sin, -20, 20}, "sin and cos together", both);
}

}  // namespace imp::bench
