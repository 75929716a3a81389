// The errors of the elementary functions: over all floats, and over many doubles and pairs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace imp::prove {

struct ElementaryOptions {
  std::vector<std::string> only;  // functions; empty: all
  std::uint64_t stride = 1;       // every so many-th float
  std::uint64_t samples = 10'000'000;
  std::string done;  // a folder with a file for every finished row; empty: none
};

// Prints the table in Markdown, row by row as they come. False if a bound does not hold.
bool elementary(const ElementaryOptions& options);

}  // namespace imp::prove
