// Economisation (Lanczos 1956): a polynomial in one variable, cut short where its Chebyshev coefficients over
// the domain are too small to matter.
#pragma once

#include <span>

#include "ir/program.h"
#include "passes/range.h"

namespace imp {

struct Economized {
  Program f;
  double error;  // |f - f as it was| <= error over the domain, proven
};

// `f` (f64, one output, without phases) where the terms of its sum that are polynomials in one input have
// as low a degree as keeps the error at `tolerance` over the box `domain` of the inputs. An inclusion of f
// as it was is one of the new f, plus [-error, error]. The same f and 0 where nothing can be cut.
Economized economize(const Program& f, std::span<const Range> domain, double tolerance);

}  // namespace imp
