#include "passes/elementary/functions.h"

namespace imp::elementary {

Expr exp(Expr x) { return make(Op::exp, x); }
Expr sinh(Expr x) { return make(Op::sinh, x); }
Expr cosh(Expr x) { return make(Op::cosh, x); }
Expr tanh(Expr x) { return make(Op::tanh, x); }

}  // namespace imp::elementary
