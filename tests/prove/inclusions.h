// Every op in every form of inclusion on many random boxes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace imp::prove {

struct InclusionOptions {
  std::vector<std::string> only;        // ops; empty: all
  std::uint64_t samples = 100'000'000;  // boxes a form
  std::string done;                     // a folder with a file for every finished row; empty: none
};

// Prints the table in Markdown, row by row as they come. False if a value lies outside.
bool inclusions(const InclusionOptions& options);

}  // namespace imp::prove
