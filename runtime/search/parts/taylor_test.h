// Singh's first-order Taylor test for a root (Singh 2008, thesis, §5.3, eq. 5.1).
#pragma once

#include "runtime/search/search.h"

namespace imp {

// Whether 0 lies between the smallest and the largest of four numbers: f at both ends of the piece [a, b], and
// what the tangents there say of its middle. It sees pairs of roots that a change of sign does not. It is a
// test, not an inclusion: it may say no where there is a root, and nothing certified follows from it.
// NaN counts as a root.
Truth taylor_test(const RayFunction& f, Expr a, Expr b);

}  // namespace imp
