// A run: neighbouring pieces of a ray that are not excluded, between excluded ones, and what it proves.
#pragma once

#include "runtime/search/search.h"

namespace imp {

struct Run {
  Truth found;         // there is a run; nothing else means anything where there is none
  Expr a, b;           // it is [a, b]; all before a is excluded
  Expr before, after;  // the proven signs of f at a and at b; 0: not known
  Truth smooth;        // f is proven defined and continuous on it
  Truth single;        // f is proven to have one root in it at most
};

// Whether df/ds is proven to be no 0 on [a, b], so that f has one root there at most.
Truth monotone(const RayFunction& f, Expr a, Expr b);

// A run across which f changes its sign is a certified hit if f is continuous on it and it is short or holds a
// single root. `miss`: all is excluded.
Found answer(const RayFunction& f, const Run& run, Truth miss, Expr steps);

}  // namespace imp
