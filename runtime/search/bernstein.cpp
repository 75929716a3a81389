// Sign variations of Bernstein coefficients (Lane and Riesenfeld 1981; along rays: Seland and Dokken 2007, §1.3).
//
// Along a ray a polynomial f of degree n is a polynomial of degree n, and n + 1 Bernstein coefficients say all of it.
// As often as these change their sign f has zeros at most: with no change a piece is excluded, with one it holds one
// root, whatever its length. So most rays take a few steps where the exclusion of small pieces takes twenty,
// and what f costs is paid once a ray: a step costs n (n + 1)/2 means, for whatever f of that degree.
//
// Right for polynomials up to degree 20, say. Undecided where f touches zero, as all searches are; and where the rounding of
// the coefficients, which are as large as f at its largest along the ray, is larger than f about the root.
#include "runtime/search/parts/walk.h"

namespace imp {

std::optional<Found> bernstein(Program& program, const RayFunction& f, const SearchLimits& limits,
                               Diagnostics& diagnostics) {
  return walk(program, f, limits, diagnostics);
}

}  // namespace imp
