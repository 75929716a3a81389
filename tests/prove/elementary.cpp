#include "tests/prove/elementary.h"

#include <fmt/format.h>

#include <algorithm>

#include "tests/prove/cores.h"
#include "tests/prove/rows.h"
#include "tests/support/arguments.h"
#include "tests/support/elementary_ops.h"
#include "tests/support/function_error.h"

namespace imp::prove {
namespace {

using test::FunctionError;

constexpr std::size_t batch = 1 << 16;

FunctionError all_floats(const test::FunctionKernel& kernel, std::uint64_t stride) {
  const std::uint64_t floats = (std::uint64_t{1} << 32) / stride;
  return on_all_cores<FunctionError>((floats + batch - 1) / batch, [&](std::uint64_t i) {
    std::vector<double> x;
    for (std::uint64_t k = i * batch; k < std::min(floats, (i + 1) * batch); ++k)
      x.push_back(test::float_of_bits(static_cast<std::uint32_t>(k * stride)));
    return kernel.measure(x, {});
  });
}

FunctionError random_arguments(const test::FunctionKernel& kernel, Type type, std::uint64_t samples) {
  return on_all_cores<FunctionError>((samples + batch - 1) / batch, [&](std::uint64_t i) {
    std::mt19937_64 random(i);
    std::vector<double> x, y;
    for (std::size_t k = 0; k < batch; ++k) {
      x.push_back(test::random_argument(random, type));
      y.push_back(test::random_argument_beside(x.back(), random, type));
    }
    return kernel.measure(x, y);
  });
}

FunctionError special_arguments(const test::FunctionKernel& kernel, Op op, Type type) {
  const auto special = test::special_arguments(type);
  if (info(op).arity == 1) return kernel.measure(special, {});
  FunctionError total;
  for (const double y : special) total.add(kernel.measure(special, std::vector(special.size(), y)));
  return total;
}

std::string row_text(Op op, Type type, bool upward, const ElementaryOptions& options) {
  const test::FunctionKernel kernel(op, type, upward);
  FunctionError error = special_arguments(kernel, op, type);
  error.add(type == f32 && info(op).arity == 1 ? all_floats(kernel, options.stride)
                                               : random_arguments(kernel, type, options.samples));
  const double bound = *elementary::ulps(op, type);
  const bool holds = error.ulps <= bound && error.wrong_kind == 0 && error.outside == 0;
  const std::string at =
      info(op).arity == 1 ? fmt::format("{:a}", error.x) : fmt::format("{:a}, {:a}", error.x, error.y);
  std::string text = fmt::format("| {} | {} | {} | {} | {:.3f} | {} | {} | {} |", info(op).name,
                                 type == f32 ? "float" : "double", upward ? "upward" : "nearest", error.tried,
                                 error.ulps, at, bound, holds ? "holds" : "FAILS");
  if (error.wrong_kind + error.outside != 0)
    fmt::print(stderr, "{}: {} of a wrong kind, {} out of bounds, the first at {:a}, {:a}\n", text,
               error.wrong_kind, error.outside, error.wrong_x, error.wrong_y);
  return text;
}

}  // namespace

bool elementary(const ElementaryOptions& options) {
  fmt::print("| function | type | rounding | arguments | largest error, ulps | at | bound | |\n");
  fmt::print("| --- | --- | --- | ---: | ---: | --- | ---: | --- |\n");
  bool all_hold = true;
  for (const Op op : test::elementary_ops()) {
    const std::string name(info(op).name);
    if (!options.only.empty() && std::ranges::find(options.only, name) == options.only.end()) continue;
    for (const Type type : {f32, f64})
      for (const bool upward : {false, true}) {
        const std::string key = fmt::format("{}-{}-{}-{}-{}", name, type == f32 ? "f32" : "f64",
                                            upward ? "up" : "nearest", options.stride, options.samples);
        const std::string text = row(options.done, key, [&] { return row_text(op, type, upward, options); });
        all_hold &= text.ends_with("holds |");
      }
  }
  return all_hold;
}

}  // namespace imp::prove
