#include "tests/prove/itf1788.h"

#include <fmt/format.h>

#include "tests/support/itf1788.h"

namespace imp::prove {
namespace {

std::string width_cells(const test::TrialCount& count) {
  if (count.measured == 0) return fmt::format("| | | | {} ", count.wide);
  const auto measured = static_cast<double>(count.measured);
  return fmt::format("| {:.0f} % | {:.2f} | {:.0f} | {} ", 100 * static_cast<double>(count.exact) / measured,
                     count.sum / measured, count.most, count.wide);
}

}  // namespace

bool itf1788(const ItfOptions& options) {
  const auto ours = std::filesystem::path(IMP_TEST_DATA) / "itf1788.txt";
  const auto vectors = test::load_test_vectors(options.vectors.empty() ? ours.string() : options.vectors);
  const auto in_double = test::try_vectors(vectors, f64), in_float = test::try_vectors(vectors, f32);

  fmt::print("| operation | vectors | missed | double: exact | mean | most | wide | ");
  fmt::print("float: exact | mean | most | wide | not empty | flags | too much | too little |\n");
  fmt::print("| --- |");
  for (int column = 1; column < 15; ++column) fmt::print(" ---: |");
  fmt::print("\n");
  test::TrialCount all;
  for (const auto& [op, d] : in_double) {
    const test::TrialCount& f = in_float.at(op);
    fmt::print("| {} | {} | {} {}{}| {} | {} | {} | {} |\n", op, d.tried, d.missed + f.missed, width_cells(d),
               width_cells(f), d.not_empty + f.not_empty, d.flags, d.overclaimed + f.overclaimed, d.shy);
    all.add(d);
    all.add(f);
  }
  if (!all.first.empty()) fmt::print(stderr, "wrong, the first: {}\n", all.first);
  return all.missed + all.overclaimed == 0;
}

}  // namespace imp::prove
