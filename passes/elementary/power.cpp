#include "passes/elementary/functions.h"

namespace imp::elementary {

Expr pow(Expr x, Expr y) { return make(Op::pow, x, y); }
Expr cbrt(Expr x) { return make(Op::cbrt, x); }

}  // namespace imp::elementary
