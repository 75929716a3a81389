#include "passes/elementary/functions.h"

namespace imp::elementary {

Expr log(Expr x) { return make(Op::log, x); }
Expr asinh(Expr x) { return make(Op::asinh, x); }
Expr acosh(Expr x) { return make(Op::acosh, x); }
Expr atanh(Expr x) { return make(Op::atanh, x); }

}  // namespace imp::elementary
