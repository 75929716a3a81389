// What an enclosure proves.
#pragma once

#include "passes/extend/interval_rules.h"

namespace imp {

// 1 where all values are positive, -1 where all are negative; else, and where there are none, 0.
inline Expr proven_sign(const Interval& f) {
  const Expr none = zero(f.hi);
  const Expr sign = select(f.nlo < 0, one(f.hi), select(f.hi < 0, -one(f.hi), none));
  return select(!f.empty && is_ordered(f), sign, none);
}

}  // namespace imp
