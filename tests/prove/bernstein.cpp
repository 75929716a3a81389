#include "tests/prove/bernstein.h"

#include <algorithm>

#include "tests/prove/rows.h"
#include "tests/support/bernstein_ways.h"
#include "tests/support/cost.h"

namespace imp::prove {
namespace {

// The widest coefficient as a share of the largest magnitude: the median and the worst of random rays.
struct Widths {
  double median, worst;
};

Widths widths(const test::PolynomialSurface& surface, const test::PieceKernel& kernel, Type type,
              double length) {
  test::Random random(0x3d7);
  std::vector<double> shares;
  for (int i = 0; i < 201; ++i) {
    double width = 0, size = 0;
    for (const auto [lo, hi] : kernel(surface.ray(random, type, length))) {
      width = std::max(width, hi - lo);
      size = std::max({size, hi, -lo});
    }
    shares.push_back(width / size);
  }
  std::ranges::sort(shares);
  return {shares[shares.size() / 2], shares.back()};
}

const char* way_name(std::size_t way) {
  return way == test::by_blossom ? "blossom" : test::bernstein_ways[way].name;
}

std::string row_text(const test::PolynomialSurface& surface) {
  std::string ops, width[2];
  for (std::size_t way = 0; way <= test::by_blossom; ++way) {
    if (way == test::by_blossom && surface.degree > 10) {
      ops += " |", width[0] += " | |", width[1] += " | |";
      continue;
    }
    for (const Type type : {f32, f64}) {
      const test::PieceKernel kernel = test::bernstein_kernel(surface, type, way);
      if (type == f32) ops += fmt::format(" {} |", test::cost(kernel.program()));
      for (const double length : {1.0, 0.0625}) {
        const auto [median, worst] = widths(surface, kernel, type, length);
        width[type == f64] += fmt::format(" {:.0e} .. {:.0e} |", median, worst);
      }
    }
  }
  return fmt::format("| {} | {} |{}{}{}", surface.degree, surface.entry->id, ops, width[0], width[1]);
}

}  // namespace

bool bernstein(const BernsteinOptions& options) {
  std::string names = "| degree | surface |", rule = "| ---: | --- |";
  const auto add = [&](const std::string& name) { names += ' ' + name + " |", rule += " ---: |"; };
  for (std::size_t way = 0; way <= test::by_blossom; ++way) add(fmt::format("ops: {}", way_name(way)));
  for (const char* type : {"float", "double"})
    for (std::size_t way = 0; way <= test::by_blossom; ++way)
      for (const char* length : {"whole", "sixteenth"})
        add(fmt::format("{}: {}, {}", type, way_name(way), length));
  fmt::print("{}\n{}\n", names, rule);
  for (const test::PolynomialSurface& surface : test::polynomial_surfaces()) {
    if (!options.only.empty() && std::ranges::find(options.only, surface.entry->id) == options.only.end())
      continue;
    row(options.done, "bernstein-" + std::string(surface.entry->id), [&] { return row_text(surface); });
  }
  return true;
}

}  // namespace imp::prove
