// How often each op stands in a Program, by region: what a ray costs.
#pragma once

#include "ir/program.h"
#include "tools/text_table.h"

namespace imp::tools {

// A row an op, the most frequent one first, and a row of totals; a column for each region that
// computes something. Only what outputs and phases need is counted; a call counts once for each of
// its outputs, whatever it calls. Empty where nothing is computed.
Table op_counts(const Program& program);

}  // namespace imp::tools
