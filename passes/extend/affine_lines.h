// Lines in the place of functions: f(u) lies within k u + rest for every u of a range, whichever way the plain
// ops round.
#pragma once

#include "passes/extend/affine.h"

namespace imp::affine {

struct Line {
  Expr factor;  // k, any number
  Ends rest;
};

Line reciprocal_line(Expr near, Expr far);  // 1/u over [near, far], where near > 0
Line root_line(Expr lo, Expr hi);           // sqrt(u) over [lo, hi], where lo >= 0 and hi > 0

}  // namespace imp::affine
