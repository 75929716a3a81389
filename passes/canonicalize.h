// Canonicalisation: writes what is the same real function in one way, so that hash-consing finds
// common sub-expressions and later passes see few forms: x^1, double negation, a - (-b),
// -a + b, products and quotients with the constants 1 and -1, comparisons with their operands
// ordered, nested selects on one condition. Preserves bits.
#pragma once

#include "ir/program.h"
#include "passes/rules.h"

namespace imp {

Program canonicalize(const Program& program);

// Its rules, each of which a test proves.
std::span<const AlgebraRule> canonical_rules();

}  // namespace imp
