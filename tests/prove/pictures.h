// Pictures by shaders beside those by machine code, over the catalogue.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace imp::prove {

struct PictureOptions {
  std::vector<std::string> only;  // surfaces; empty: all
  std::size_t size = 128;         // pixels a side
  std::string done;               // a folder with a file for every finished row; empty: none
};

// Prints the table in Markdown, row by row as they come. False where a verdict contradicts another, or
// more than forty pixels are drawn otherwise. A surface that is too large for a shader is "refused".
bool pictures(const PictureOptions& options);

}  // namespace imp::prove
