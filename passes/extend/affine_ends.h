// The errors of affine forms: sets [-nlo, hi] that hold 0, as neither end is negative. Both ends round upward. Where
// they are one node, as all of AF1 are, so are those made of them.
#pragma once

#include "ir/expr.h"

namespace imp::affine {

struct Ends {
  Expr nlo, hi;
};

inline Ends both(Expr end) { return {end, end}; }
inline Ends turned(const Ends& a) { return {a.hi, a.nlo}; }
inline bool is_symmetric(const Ends& a) { return a.nlo == a.hi; }
Expr larger(const Ends& a);

inline bool is_zero(Expr a) { return a.graph->number(a.id) == 0.0; }
Expr sum_of_product_up(Expr a, Expr b, Expr c);  // a b + c

Ends plus(const Ends& a, const Ends& b);

// sum + factor d; for a factor >= 0, and for any.
Ends plus_multiple(const Ends& sum, Expr factor, const Ends& d);
Ends plus_product(const Ends& sum, Expr factor, const Ends& d);

// sum + a b.
Ends plus_set_product(const Ends& sum, const Ends& a, const Ends& b);

}  // namespace imp::affine
