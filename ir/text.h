// The text form of Programs: what `imp inspect` prints, what golden files hold, what a failing test
// prints to be pasted into another. It round-trips: parse(to_text(p)) == p.
//
//   program march
//     calls distance                      # other programs of the text, before this one
//     input frame r: f32
//     input ray x: f32
//
//     # once a ray
//     %xx = mul %x %x
//
//     phase bisect 64                     # at most 64 steps
//       enter %1                          # left out: every ray enters
//       state t: f32 = 0f
//       %2 = call distance.d %t %xx       # the output d of distance
//       %3 = add %t %2
//       %4 = lt %3 10f
//       next t = %3                       # left out: the state keeps its value
//       again %4
//     end
//
//     output t = %bisect.t
//   end
//
// Operands are %names or constants: 0.5 is an f64, 0.5f an f32; inf, nan, inff, nanf, true, false. A
// constant is the shortest text that reads back to it. In its phase the state t is %t (%bisect.t, if
// an input is called t too), after the phase it is %bisect.t. Names the author gave to nodes are kept,
// made unique by _2, _3, …; the others are numbered. A name that is not a word is in quotes: %"a b".
// The second callee named f is f@2. Tables: %s = fill f32[16] 0f, load %s %i, store %s %i %v.
//
// A stage of a pipeline is a line before its program: stage 16 16 1 (columns, rows, slabs).
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "ir/diagnostics.h"
#include "ir/program.h"
#include "ir/stage.h"

namespace imp {

// Callees come first, each a program of its own.
std::string to_text(const Program& program);
std::string to_text(const Pipeline& pipeline);

// The last program of the text; the earlier ones are those it may call. Errors point into the text,
// which is added to `diagnostics.sources` under `name`.
std::optional<Program> parse_program(std::string text, std::string name, Diagnostics& diagnostics);
std::optional<Pipeline> parse_pipeline(std::string text, std::string name, Diagnostics& diagnostics);

}  // namespace imp
