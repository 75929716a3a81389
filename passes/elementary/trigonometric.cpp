#include "passes/elementary/functions.h"

namespace imp::elementary {

Expr sin(Expr x) { return make(Op::sin, x); }
Expr cos(Expr x) { return make(Op::cos, x); }
Expr tan(Expr x) { return make(Op::tan, x); }

}  // namespace imp::elementary
