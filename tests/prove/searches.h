// Every strategy on random rays at the catalogue's surfaces, against dense samples of f along the rays.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace imp::prove {

struct SearchOptions {
  std::vector<std::string> only;                      // surfaces; empty: all
  std::vector<std::string> strategies;                // empty: all
  std::vector<std::string> inclusions{"auto", "ia"};  // with each strategy
  std::size_t rays = 20'000;                          // a surface
  std::string done;  // a folder with a file for every finished cell; empty: none
};

// Prints two tables in Markdown: by surface, what share of the easy rays is decided, row by row as they come; and
// by strategy, what was answered. False if a certified answer is wrong: its ray is printed on standard error.
bool searches(const SearchOptions& options);

}  // namespace imp::prove
