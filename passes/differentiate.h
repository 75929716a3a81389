// Symbolic differentiation, with zeros propagated: no 0*x is ever built.
//
// Through min, max, abs and if, a derivative is a selection around the whole chain: the branch not
// taken contributes 0, not 0*inf (acosh(max(1, abs(x))) at 0 has derivative 0).
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "ir/diagnostics.h"
#include "ir/program.h"

namespace imp {

// `program` with, after its own outputs and for each of them (f) and each named input (x), an
// output "fx": the partial derivative. Errors point at the op that has none.
std::optional<Program> differentiate(const Program& program, std::span<const std::string_view> inputs,
                                     Diagnostics& diagnostics);

// Outputs f, fx, fy, fz; and f, fx, fy, fz, fxx, fxy, fxz, fyy, fyz, fzz.
std::optional<Program> gradient(const Program& f, Diagnostics& diagnostics);
std::optional<Program> hessian(const Program& f, Diagnostics& diagnostics);

}  // namespace imp
