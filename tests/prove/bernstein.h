// The ways to Bernstein coefficients along a ray: what they cost, and how wide they are.
#pragma once

#include <string>
#include <vector>

namespace imp::prove {

struct BernsteinOptions {
  std::vector<std::string> only;  // surfaces; empty: all
  std::string done;               // a folder with a file for every finished row; empty: none
};

// Prints the table of docs/decisions/bernstein.md, row by row as they come: ops in float, then widths on whole
// rays and on sixteenths, in float and in double. There is nothing that can fail.
bool bernstein(const BernsteinOptions& options);

}  // namespace imp::prove
