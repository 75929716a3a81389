// A run: neighbouring pieces of a ray that are not excluded, between excluded ones, and what it proves.
#pragma once

#include "ir/loop.h"
#include "runtime/search/search.h"

namespace imp {

struct Run {
  Truth found;         // there is a run; nothing else means anything where there is none
  Expr a, b;           // it is [a, b]; all before a is excluded
  Expr before, after;  // the proven signs of f at a and at b; 0: not known
  Truth smooth;        // f is proven defined and continuous on it
  Truth single;        // f is proven to have one root in it at most
};

// A run as states of a phase, none at first, for searches that know monotone pieces.
struct RunStates {
  Truth open;          // in a run
  Expr start;          // where it began
  Expr slope;          // the sign of df/ds on it; 0: not monotone
  Expr before, after;  // the signs of f before it, or where the search is, and behind it; 0: not known
  Truth smooth;        // f is continuous on it
};
RunStates run_states(Program& program, Loop& loop, Expr like);

// What is left of them after the phase, for a run that ends at `end`.
Run run_after(const Loop& loop, const RunStates& states, Expr end);

// Whether df/ds is proven to be no 0 on [a, b], so that f has one root there at most.
Truth monotone(const RayFunction& f, Expr a, Expr b);

// A run across which f changes its sign is a certified hit if f is continuous on it and it is short or holds a
// single root. `miss`: all is excluded.
Found answer(const RayFunction& f, const Run& run, Truth miss, Expr steps);

}  // namespace imp
