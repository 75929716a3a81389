// What elementary functions are made of: polynomials, and sums whose error is kept. Everything here
// holds where the basic ops round to nearest and where they round upward.
#pragma once

#include <span>

#include "ir/expr.h"

namespace imp::elementary {

// coefficients[0] + coefficients[1] x + …, by Horner's rule.
Expr polynomial(Expr x, std::span<const double> coefficients);

}  // namespace imp::elementary
