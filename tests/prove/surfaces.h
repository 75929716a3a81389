// The catalogue's surfaces in every form of inclusion: no value outside, and how tight the forms are.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace imp::prove {

struct SurfaceOptions {
  std::vector<std::string> only;   // surfaces; empty: all
  std::uint64_t samples = 10'000;  // boxes a form and type; of tightness a hundredth of them
  std::string done;                // a folder with a file for every finished row; empty: none
};

// Prints the table in Markdown, row by row as they come. False if a value lies outside.
bool surfaces(const SurfaceOptions& options);

// Widths of enclosures by those of the ranges, at three sizes of boxes.
bool tightness(const SurfaceOptions& options);

}  // namespace imp::prove
