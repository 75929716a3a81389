// How the first root of a surface is found: by what was asked for, and elsewhere by what fits the formula.
#pragma once

#include <string>

#include "passes/extend/inclusion.h"
#include "runtime/options.h"
#include "runtime/search/search.h"

namespace imp {

// What was asked for. Null is `auto`.
struct Wish {
  const Search* search = nullptr;
  const Inclusion* inclusion = nullptr;
};

struct Method {
  const Search* search;
  const Inclusion* inclusion;
  bool again;          // whether there is a second look at what stays undecided
  std::string reason;  // of what was chosen here, for the reader; empty where all was asked for
};

// What is asked for in the second look, in double, where this was asked for in floats, and no search by its name:
// isolate, as a ray is seldom undecided for both it and bernstein.
Wish second_wish(const Wish& wish);

// For `f` (f64, simplified) in a kernel like this.
Method choose_method(const Program& f, const Wish& wish, const KernelOptions& kernel);

// "search isolate, inclusion ia (auto: …)"
std::string to_text(const Method& method);

}  // namespace imp
