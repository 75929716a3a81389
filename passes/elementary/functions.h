// The elementary functions as expressions of basic ops: + - * / sqrt, compare, select, floor, exponent,
// scale2; no fma, which not every target fuses. So they are inlined, share their work with their
// neighbours (sin and cos of one argument reduce it once), and mean the same on every backend.
//
// Each takes f32 or f64 and gives the same type. At infinities, NaN, zeros and outside the domain they
// answer as C's math library does, with two exceptions: the angle functions are NaN beyond
// `largest_angle`, and the real power is NaN for a base below 0. How far off they are: bounds.h.
#pragma once

#include "ir/expr.h"

namespace imp::elementary {

Expr exp(Expr x);
Expr sinh(Expr x);
Expr cosh(Expr x);
Expr tanh(Expr x);

Expr log(Expr x);
Expr asinh(Expr x);
Expr acosh(Expr x);
Expr atanh(Expr x);

Expr pow(Expr x, Expr y);
Expr cbrt(Expr x);

Expr sin(Expr x);
Expr cos(Expr x);
Expr tan(Expr x);

Expr asin(Expr x);
Expr acos(Expr x);
Expr atan(Expr x);
Expr atan2(Expr y, Expr x);

}  // namespace imp::elementary
