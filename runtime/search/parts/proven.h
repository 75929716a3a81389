// What an enclosure proves.
#pragma once

#include "passes/extend/interval_rules.h"

namespace imp {

// 1 where all values are positive, -1 where all are negative; else, and where there are none, 0.
inline Expr proven_sign(const Interval& f) {
  const Expr sign = select(is_positive(f), one(f.hi), select(is_negative(f), -one(f.hi), zero(f.hi)));
  return select(f.empty, zero(sign), sign);
}

}  // namespace imp
