// What elementary functions are made of: polynomials, sums whose error is kept, numbers taken apart.
// Everything here holds where the basic ops round to nearest and where they round upward.
#pragma once

#include <span>

#include "ir/expr.h"

namespace imp::elementary {

// coefficients[0] + coefficients[1] x + …, by Horner's rule.
Expr polynomial(Expr x, std::span<const double> coefficients);

// The coefficients for the type of `like`.
inline std::span<const double> table(Expr like, std::span<const double> for_f32,
                                     std::span<const double> for_f64) {
  return like.type() == f32 ? for_f32 : for_f64;
}

// A number of twice the precision: high + low, where low is about an ulp of high, or less.
struct Sum {
  Expr high, low;
};

// big + small, exactly but for an ulp of `low`, where big = 0 or |big| >= |small| (Dekker 1971).
Sum exact_sum(Expr big, Expr small);

// `x` without the lower half of its digits, so that the product of two such is exact: at most 12 digits
// in f32, 26 in f64 (Veltkamp 1968). |x| below 2^-14, 2^-28 of the largest number.
Expr upper_half(Expr x);

// log 2, and with so few digits in `high` that its product with an exponent is exact.
struct Log2 {
  double high, low;
};
Log2 log_of_2(Type type);

// x = 2^e m with sqrt(1/2) <= m < sqrt(2), exactly, for finite x > 0. Where x = 0: e = -inf, m = 0.
struct Parts {
  Expr e, m;
};
Parts take_apart(Expr x);

// e^(high + low), which may overflow and fade out to 0; |low| is about an ulp of `high` or less.
Expr exp_of_sum(Sum x);

// An odd function, from its values for x >= 0; it is x itself where |x| < tiny.
Expr odd(Expr x, Expr value_at_abs_x, double tiny);

// `value` for 0 <= x < inf, else as the logarithm: NaN below 0, and x where that is inf or NaN.
Expr on_positive(Expr x, Expr value);

}  // namespace imp::elementary
