// imp_bench: tables by name (--table NAME [--target NAME]), and else the benchmarks, as Google Benchmark runs them.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <string_view>

#include "bench/tables.h"

namespace {

struct Table {
  std::string_view name;
  void (*print)();
};

constexpr Table tables[] = {
    {"knoll", imp::bench::print_knoll_table},           {"rates", imp::bench::print_rates_table},
    {"examples", imp::bench::print_examples_table},     {"first-pixel", imp::bench::print_first_pixel_table},
    {"elementary", imp::bench::print_elementary_table}, {"evaluations", imp::bench::print_evaluations_table},
};

int print_table(std::string_view name) {
  for (const Table& table : tables)
    if (table.name == name) return table.print(), 0;
  fmt::print(stderr, "no table '{}'; there are:", name);
  for (const Table& table : tables) fmt::print(stderr, " {}", table.name);
  fmt::print(stderr, "\n");
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 5 && argv[3] == std::string_view("--target")) imp::bench::only_target = argv[4], argc = 3;
  if (argc == 3 && argv[1] == std::string_view("--table")) return print_table(argv[2]);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
