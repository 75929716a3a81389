// The natural interval extension as a pass, and as a function for use within a larger Program.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "ir/diagnostics.h"
#include "passes/extend/interval_rules.h"
#include "passes/range.h"

namespace imp {

// Enclosures of the outputs of `f` (f64, constants unresolved) for enclosures of its inputs, built
// in the graph and the type of `inputs`. `domain`, if given, holds a range for each input, which
// the boxes will never leave: bounds known to be finite then need no care for 0 * inf.
// Errors point at an op that has no interval rule.
std::optional<std::vector<Interval>> enclose(const Program& f, std::span<const Interval> inputs,
                                             Diagnostics& diagnostics, std::span<const Range> domain = {});

// For a Program with inputs x, … and outputs f, … of type f64 the Program over boxes: inputs xlo,
// xhi, … of type f64, which are narrowed outward where `type` is f32; outputs flo, fhi (f64,
// inf and -inf where empty) and fdefined (truth: defined and continuous on the whole box).
// An input that is not a box (lo > hi or NaN) has no points: the answer is empty and not defined.
std::optional<Program> interval_extension(const Program& f, Type type, Diagnostics& diagnostics);

}  // namespace imp
