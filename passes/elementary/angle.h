// What the angle functions share: the argument less its quarter turns, sine and cosine of the rest, and
// quotients in more digits than the type has.
#pragma once

#include "passes/elementary/pieces.h"

namespace imp::elementary {

// A number of more digits than its type has: head - excess. A difference, since that of a zero and +0 is
// this zero: odd functions keep its sign.
struct Difference {
  Expr head, excess;
};

// An angle as a number of quarter turns, of which it matters whether it is odd and whether it is 2 or 3
// modulo 4, and the rest, at most an eighth of a turn and a little.
struct Angle {
  Difference rest;
  Expr square;  // of rest.head
  Truth odd, turned;
};

// NaN beyond `largest_angle`.
Angle reduced(Expr x);

// sin and cos of angle.rest, and 2 tan(angle.rest/2) with its rounding error.
Expr sine(const Angle& angle);
Expr cosine(const Angle& angle);
Difference double_half_tangent(const Angle& angle);

// numerator/denominator to about 3/2 of the type's digits, high having half of them; `reciprocal` is
// 1/denominator.head. Both operands are normalised and far from the ends of the range.
Sum quotient(Difference numerator, Difference denominator, Expr reciprocal);

// pi/2, and multiples of it by powers of 2, in two pieces: high + low.
struct HalfPi {
  double high, low;
};
HalfPi half_pi(Type type);

}  // namespace imp::elementary
