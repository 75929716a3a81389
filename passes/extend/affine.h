// Reduced affine arithmetic as a number type that builds nodes: Messine's AF1 (2002), as in Knoll et al.
// 2009, §3.3.2, eq. 15. A quantity is c + x1 u1 + … + xn un + e [-1, 1] with the symbols u1, …, un in
// [-1, 1]: what depends on them linearly stays together, everything else goes into e.
//
// Messine's AF2 has two errors more, p [0, 1] and n [-1, 0], so that a square goes to p and c stays where it was. As
// no error term is ever recognized again, all three together are [-(e + n), e + p], and these two ends are what a form
// has. In AF1 they are one and the same node, and so is what is made of them. Lines in the place of functions have
// their rest on both sides in AF2 too.
//
// Every rounding goes into e too. The operations on c and x are plain ones, each off by at most eps of its
// result or what is denormal (design: faithful, denormals may be flushed); those on e round upward. Each rule
// states in its place what it charges.
#pragma once

#include <optional>
#include <vector>

#include "passes/extend/affine_ends.h"
#include "passes/extend/interval_rules.h"

namespace imp {

struct Affine {
  Expr c;
  std::vector<Expr> x;  // the constant 0 where there is no dependence
  affine::Ends e;       // neither is negative
  double limit;   // |c| + Σ|xi| + e never exceeds it, on any box. Infinity: one may be infinite or NaN, and
                  // then this is no form
  int spare = 0;  // so many results below the smallest normal number may still be flushed at the cost of e
  bool signed_errors = false;  // AF2: the ends of e may differ. Never is one NaN where all else is finite
};

namespace affine {

// What the forms of a Program have in common.
struct Shape {
  std::size_t symbols;
  bool signed_errors = false;
};

// Forms that never come near an overflow.
bool is_bounded(const Affine& a);

double eps(Type type);              // what a plain op may be off by, of its result
double smallest_normal(Type type);  // and what it may lose below it
bool is_power_of_two(double value);

// So far from overflow that a rounding more or less does not matter.
double safe(Type type);

// The number `value`, give or take `error`: exact where that is 0.
Affine constant(Expr like, const Shape& shape, double value, double error);

// An interval whose place is told by symbol `symbol`; by no symbol, without a tie to anything else. `limit`: of
// its ends.
Affine of_interval(const Interval& a, const Shape& shape, std::optional<std::size_t> symbol, double limit);

Ends deviation(const Affine& a);  // from c
Expr radius(const Affine& a);     // Σ|xi| + e, with the larger end of e
Expr magnitude(const Affine& a);  // |c| + Σ|xi| + e
Truth is_form(const Affine& a);   // false where a part is infinite or NaN

Ends ends(const Affine& a);  // they mean nothing where it is no form

Affine neg(const Affine& a);
Affine add(const Affine& a, const Affine& b);
Affine sub(const Affine& a, const Affine& b);
Affine mul(const Affine& a, const Affine& b);
Affine square(const Affine& a);
Affine cube(const Affine& a);

// factor a, where the factor is `value` (not 0), or within 2 eps of it.
Affine scale(const Affine& a, double value, bool exact);

// factor a + [-rest.nlo, rest.hi]: what the linear rules of non-affine functions come down to. `limit` is of
// the result.
Affine line(const Affine& a, Expr factor, const Ends& rest, double limit);

// Where c the one, else the other.
Affine select(Truth c, const Affine& a, const Affine& b);

}  // namespace affine
}  // namespace imp
