// The Bernstein form of a polynomial over a box (Cargo and Shisha 1966): f lies between the least and the
// greatest of its Bernstein coefficients, and along a line it has at most as many zeros as these change sign.
#pragma once

#include "passes/extend/inclusion.h"
#include "passes/polynomial/degree.h"

namespace imp {

// For a polynomial in the variables of a box: an enclosure of each coefficient of the product basis. Of one
// variable they are in order; of more, the first variable runs fastest. Where one is empty, all mean nothing.
struct Bernstein {
  std::vector<std::uint32_t> degrees;  // in each variable
  std::vector<Interval> coefficients;
};

// Each output of `f` (f64, constants unresolved) over the box, whose sides are finite, by its values at
// (degree + 1) points an axis and a constant matrix. Errors point at what makes it no polynomial or has no
// interval rule, or say that too many points are needed.
std::optional<std::vector<Bernstein>> bernstein_by_samples(const Program& f, const InputBox& box,
                                                           Diagnostics& diagnostics);

// The same in the one variable of the box: by the power basis and a constant matrix; and by the ops of f over
// polynomials in Bernstein form (Farouki and Rajan 1988), where nothing cancels but what cancels in f.
std::optional<std::vector<Bernstein>> bernstein_by_powers(const Program& f, const InputBox& box,
                                                          Diagnostics& diagnostics);
std::optional<std::vector<Bernstein>> bernstein_by_products(const Program& f, const InputBox& box,
                                                            Diagnostics& diagnostics);

// From the least coefficient to the greatest: encloses f over the box.
Interval range_of(std::span<const Interval> coefficients);

}  // namespace imp
