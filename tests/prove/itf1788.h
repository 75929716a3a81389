// The test vectors of IEEE 1788 on the interval extension, with what is lost in width.
#pragma once

#include <string>

namespace imp::prove {

struct ItfOptions {
  std::string vectors;  // a file as tools/convert_itf1788.py writes it; empty: the one in tests/data
};

// Prints the table in Markdown. False where an answer does not hold what is right, or says "defined and
// continuous" where that is wrong.
bool itf1788(const ItfOptions& options);

}  // namespace imp::prove
