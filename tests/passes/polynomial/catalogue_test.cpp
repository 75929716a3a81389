// The ways to Bernstein coefficients along rays agree on the polynomials of the catalogue. What they cost and how
// wide they are: tools/dev prove bernstein.
#include <gtest/gtest.h>

#include "tests/support/bernstein_ways.h"

namespace imp::test {
namespace {

TEST(BernsteinCatalogue, the_ways_agree) {
  Random random(0xa9e);
  for (const PolynomialSurface& surface : polynomial_surfaces()) {
    if (surface.degree > 10) continue;
    for (const Type type : {f32, f64}) {
      std::vector<PieceKernel> kernels;
      for (std::size_t way = 0; way < by_blossom; ++way)
        kernels.push_back(bernstein_kernel(surface, type, way));
      if (surface.degree <= 6) kernels.push_back(bernstein_kernel(surface, type, by_blossom));
      for (int i = 0; i < 10; ++i) {
        const RayPiece ray = surface.ray(random, type, i % 2 ? 1 : 0.125);
        std::vector<Ends> meet(surface.degree + 1, {-INFINITY, INFINITY});
        for (const PieceKernel& kernel : kernels) {
          const auto found = kernel(ray);
          ASSERT_EQ(found.size(), meet.size());
          for (std::size_t k = 0; k < meet.size(); ++k)
            meet[k] = {std::max(meet[k].lo, found[k].lo), std::min(meet[k].hi, found[k].hi)};
        }
        for (const auto [lo, hi] : meet) EXPECT_LE(lo, hi) << surface.entry->id;
      }
    }
  }
}

}  // namespace
}  // namespace imp::test
