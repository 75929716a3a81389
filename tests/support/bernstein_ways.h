// The ways to Bernstein coefficients along rays, on the polynomials of the catalogue.
#pragma once

#include "passes/polynomial/bernstein.h"
#include "passes/polynomial/blossom.h"
#include "tests/support/catalogue.h"
#include "tests/support/ray_pieces.h"

namespace imp::test {

struct BernsteinWay {
  const char* name;
  std::optional<std::vector<Bernstein>> (*coefficients)(const Program&, const InputBox&, Diagnostics&);
};

inline constexpr BernsteinWay bernstein_ways[] = {
    {"samples", bernstein_by_samples}, {"powers", bernstein_by_powers}, {"products", bernstein_by_products}};

// Behind them: the blossom of a control net.
inline constexpr std::size_t by_blossom = std::size(bernstein_ways);

// A surface without parameters, and rays whose ends lie in the box around its domain.
struct PolynomialSurface {
  const SurfaceEntry* entry;
  Program f;
  std::uint32_t degree;

  RayPiece ray(Random& random, Type type, double length) const {
    RayPiece result{0, 1, {}, {}, 0};
    for (std::size_t i = 0; i < 3; ++i) {
      const double lo = entry->domain.lo[i], hi = entry->domain.hi[i];
      const double from = random.between(lo, hi), to = random.between(lo, hi);
      result.o[i] = from, result.d[i] = to - from;
      if (type == f32)
        result.o[i] = static_cast<float>(result.o[i]), result.d[i] = static_cast<float>(result.d[i]);
    }
    result.s0 = length < 1 ? std::floor(random.unit() / length) * length : 0;
    result.s1 = result.s0 + length;
    return result;
  }
};

inline std::vector<PolynomialSurface> polynomial_surfaces() {
  constexpr std::size_t xyz[] = {0, 1, 2};
  std::vector<PolynomialSurface> result;
  for (const SurfaceEntry* entry : algebraic_entries()) {
    Diagnostics diagnostics;
    Program f = model_of(*entry).surfaces.at(0).f;
    const auto degree = degrees(f, xyz, diagnostics);
    if (degree && f.inputs.size() == 3 && degree->front().total <= 14)
      result.push_back({entry, std::move(f), degree->front().total});
  }
  std::ranges::sort(result, {}, &PolynomialSurface::degree);
  return result;
}

inline std::vector<Interval> blossom_along(const PolynomialSurface& surface,
                                           std::span<const Interval> inputs) {
  const auto &lo = surface.entry->domain.lo, &hi = surface.entry->domain.hi;
  const IntervalRules rules;
  const Interval &s = inputs[0], start = interval(s.nlo, -s.nlo), end = interval(-s.hi, s.hi);
  SpacePoint from, to;
  for (std::size_t i = 0; i < 3; ++i) {
    from[i] = rules.add(inputs[1 + i], rules.mul(start, inputs[4 + i]));
    to[i] = rules.add(inputs[1 + i], rules.mul(end, inputs[4 + i]));
  }
  Diagnostics diagnostics;
  const auto net =
      control_net(surface.f, {{{lo[0], hi[0]}, {lo[1], hi[1]}, {lo[2], hi[2]}}}, {}, s.hi, diagnostics);
  return blossomed(*net, from, to);
}

inline PieceKernel bernstein_kernel(const PolynomialSurface& surface, Type type, std::size_t way) {
  return {surface.f, type, [&](const Program& along, std::span<const Interval> inputs) {
            if (way == by_blossom) return blossom_along(surface, inputs);
            constexpr std::size_t variable[] = {0};
            Diagnostics diagnostics;
            const auto found = bernstein_ways[way].coefficients(
                along, {inputs.first(along.inputs.size()), variable}, diagnostics);
            return found->front().coefficients;
          }};
}

}  // namespace imp::test
