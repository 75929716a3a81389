// The verifier: what makes a Program legal. Run after every pass in debug builds.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "ir/program.h"

namespace imp {

// Empty if the Program is legal, else the first thing that is wrong with it:
//   operands exist, come first and have the types of the op; constants are in range
//   inputs, states and calls are within their tables and of the declared type
//   a state is used only inside its phase, a result only after it
//   `enter` and `again` are truths; `init` lives before the phase, `next` has the state's type
//   output, input, phase and state names are unique and not empty
//   the operands of powi and chebyshev after the first are constant integers in range
//   tables are of numbers, 65536 at most; an output is no table, an input of rate ray neither
//   a phase has at least one step; callees are legal, and listed once
std::string verify(const Program& program);

// What is wrong with the constant integers among the operands of powi and chebyshev; empty if nothing is.
std::string_view wrong_integers(const Graph& graph, Op op, std::span<const Id> args);

}  // namespace imp
