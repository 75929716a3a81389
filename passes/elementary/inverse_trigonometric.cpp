#include "passes/elementary/functions.h"

namespace imp::elementary {

Expr asin(Expr x) { return make(Op::asin, x); }
Expr acos(Expr x) { return make(Op::acos, x); }
Expr atan(Expr x) { return make(Op::atan, x); }
Expr atan2(Expr y, Expr x) { return make(Op::atan2, y, x); }

}  // namespace imp::elementary
