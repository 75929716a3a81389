// What a formula goes through before its derivatives and extensions are taken.
#pragma once

#include "passes/fraction.h"
#include "passes/pass.h"

namespace imp {

// For f in f64 with exact constants. They keep the value, so that all that is made of f is about the same surface.
std::span<const Pass> surface_passes();

// `f` behind them. What they are done with they leave alone.
Program simplified(const Program& f, PassTrace* trace = nullptr);

// What is searched for zeros in place of a simplified `f`: without its poles, and simplified again.
Fraction searched(const Program& f);

}  // namespace imp
