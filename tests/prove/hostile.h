// Does `imp` answer whatever it is given?
#pragma once

#include <cstdint>

namespace imp::prove {

struct HostileOptions {
  double minutes = 1;
  std::uint64_t seed = 1;
};

// Prints what did not end as it should, with what is needed to try it again; whether there was none.
bool hostile(const HostileOptions& options);

}  // namespace imp::prove
