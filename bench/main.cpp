// imp_bench: tables by name (--table NAME [--only SURFACES] [--target NAME]), and else the benchmarks, as Google
// Benchmark runs them.
#include <benchmark/benchmark.h>

#include <CLI/CLI.hpp>
#include <map>
#include <string_view>

#include "bench/tables.h"

namespace {

using imp::bench::only;

int print_table(int argc, char** argv) {
  const std::map<std::string, void (*)()> tables = {
      {"knoll", imp::bench::print_knoll_table},
      {"rates", imp::bench::print_rates_table},
      {"examples", imp::bench::print_examples_table},
      {"first-pixel", imp::bench::print_first_pixel_table},
      {"elementary", imp::bench::print_elementary_table},
      {"evaluations", imp::bench::print_evaluations_table},
      {"strategies", imp::bench::print_strategies_table},
  };
  CLI::App app("figures that mean something side by side");
  std::string name;
  app.add_option("--table", name, "which")->required()->check(CLI::IsMember(tables));
  app.add_option("--only", only.surfaces, "rows of these surfaces")->delimiter(',');
  app.add_option("--target", only.target, "kernels for this target: avx512, avx2, sse4.1");
  CLI11_PARSE(app, argc, argv);
  tables.at(name)();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && argv[1] == std::string_view("--table")) return print_table(argc, argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
