// How far the elementary functions of functions.h may be off: stated once, established by
// `tools/dev prove` (docs/guarantees.md), used by every inclusion extension.
#pragma once

#include <optional>

#include "ir/expr.h"

namespace imp::elementary {

// The largest error of the function `op` computed in `type`, in ulps of the exact value, where the
// basic ops round to nearest or upward; nothing for ops that are no elementary functions. f32: the
// maximum over all arguments (of functions of two arguments: over those tried, with a margin); f64:
// several times the largest error seen.
std::optional<double> ulps(Op op, Type type);

// Beyond it the values of sin, cos and tan are NaN: the reduced argument would be wrong. There, in f64, rounding an
// argument moves it by up to 1.2e-7, about as much as rounding a float near 1.
double largest_angle(Type type);

// Bounds of the exact value of a function, of which `value` is the computed one: rounded upward,
// above(op, v) is never below it, and neither is minus_below(op, v) below its negative.
Expr above(Op op, Expr value);
Expr minus_below(Op op, Expr value);

}  // namespace imp::elementary
