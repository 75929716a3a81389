// Blossoming (Seland and Dokken 2007): a polynomial in x, y, z in Bernstein-Bézier form over a tetrahedron,
// which is made once, and from it the Bernstein coefficients along any line within.
#pragma once

#include "passes/extend/inclusion.h"
#include "passes/polynomial/polynomial_rules.h"

namespace imp {

// The coefficients over a tetrahedron around a box, by the powers of the four barycentric coordinates in
// their Bernstein polynomial. For a ± r an axis of the box, the corners are a + s(1, 1, 1), a + s(1, -1, -1),
// a + s(-1, 1, -1) and a + s(-1, -1, 1) with s = 3.25 r: so it holds a little more than the box.
struct ControlNet {
  std::uint32_t degree;
  Polynomial coefficients;
  std::array<double, 3> centre, size;  // a and s; numbers of the type of the coefficients
};

// Of the first output of `f` (f64, constants unresolved; inputs x, y, z and the parameters), computed in f64
// and rounded outward to the type of `parameters`. What is constant is so in the net. Errors as of power_basis().
std::optional<ControlNet> control_net(const Program& f, const std::array<Range, 3>& box,
                                      std::span<const Interval> parameters, Expr like,
                                      Diagnostics& diagnostics);

using SpacePoint = std::array<Interval, 3>;

// The Bernstein coefficients of f along the segment from one point to another, which lie in the box, or outside by a
// twentieth of it at most (eq. 1.10).
std::vector<Interval> blossomed(const ControlNet& net, const SpacePoint& from, const SpacePoint& to);

}  // namespace imp
