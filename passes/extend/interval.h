// The natural interval extension, for use within a larger Program.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "ir/diagnostics.h"
#include "passes/extend/interval_rules.h"
#include "passes/range.h"

namespace imp {

struct Enclosure;

// The interval of a constant, empty where it has no value.
Interval constant_interval(Graph& graph, Type type, const Enclosure& value);

// Enclosures of the outputs of `f` (f64, constants unresolved) for enclosures of its inputs, built
// in the graph and the type of `inputs`. `domain`, if given, holds a range for each input, which
// the boxes will never leave: bounds known to be finite then need no care for 0 * inf.
// Errors point at an op that has no interval rule.
std::optional<std::vector<Interval>> enclose(const Program& f, std::span<const Interval> inputs,
                                             Diagnostics& diagnostics, std::span<const Range> domain = {});

// Of every node that has a rule, by index, the numbers and the truths.
std::vector<std::optional<IntervalRules::Value>> enclose_nodes(const Program& f,
                                                               std::span<const Interval> inputs,
                                                               std::span<const Range> domain = {});

}  // namespace imp
