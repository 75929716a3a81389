// The forms of inclusion functions, each in the file of its name. docs/extensions.md has a page on each.
#pragma once

#include "passes/extend/inclusion.h"

namespace imp {

// The natural interval extension (Moore 1966): every op by its interval rule.
Form interval_form;

// Reduced affine arithmetic (Messine's AF1, 2002), a symbol for each variable of the box; alone, and with each range
// on the way intersected with that of interval arithmetic.
Form affine_form;
Form affine_and_interval_form;

// Affine forms whose errors keep their signs (Messine's AF2, 2002).
Form signed_affine_form;

// Both at once, and either where it pays: see auto.cpp.
Form auto_form;

// Of these two the one for f and the other outputs of a Program in x, y, z: with intersections where they make small
// boxes of the domain much narrower.
Form& affine_form_for(const Program& f, std::span<const Range> domain);

// All below are centred: f in the middle c of the box, and bounds of what the way to its points may add. Where f
// may not be continuous or a bound is missing, intervals stand in; elsewhere the two are intersected.

// f(c) + F'(X)(X - c) with the interval gradient F' and the middle c of the box: the mean value form (Moore
// 1966; Caprani and Madsen 1980), which is the Taylor form of order 1. Its excess over the range
// shrinks with the square of the width.
Form mean_value_form;

// The same with slopes F[c, X] in the place of derivatives (Krawczyk and Neumaier 1985): never wider, at
// corners too.
Form slope_form;

// f(c) + f'(c)(X - c) + (X - c)ᵀ F''(X) (X - c)/2: the Taylor form of order 2.
Form taylor_form;

// The form of Cornelius and Lohner (1984): in one variable its excess shrinks with the cube of the width.
Form cubic_form;

// The least and the greatest Bernstein coefficient (Cargo and Shisha 1966), for polynomials in the variables:
// along a ray, or of low degree in a box. Its excess shrinks with the square of the width. Errors point at
// what makes f no polynomial in them, or say that it would take too many values of f.
Form bernstein_form;

}  // namespace imp
