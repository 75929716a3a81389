// Tables: figures that only mean something side by side, measured in turns within one run. In Markdown,
// on standard output:  tools/dev bench --table NAME [--only SURFACES] [--target NAME]
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace imp::bench {

// What is asked for, where it is not all of a table.
struct Only {
  std::vector<std::string> surfaces;
  std::string target;  // of the LLVM backend; the host's own if empty

  std::string target_name() const { return target.empty() ? "host" : target; }
  bool widest() const { return target.empty() || target == "avx512"; }
  bool skips(std::string_view surface) const {
    return !surfaces.empty() && std::ranges::find(surfaces, surface) == surfaces.end();
  }
};
inline Only only;

void print_knoll_table();        // frames of Knoll et al. 2009, Table 1
void print_strategies_table();   // every strategy beside kernels written by hand
void print_rates_table();        // frames a second as the command draws them
void print_examples_table();     // what every example takes, and what is left undecided
void print_first_pixel_table();  // from the start of the process to the first pixel
void print_elementary_table();   // elementary functions, a lane
void print_evaluations_table();  // values, derivatives and enclosures, a lane

// Of an odd number of values the one in the middle.
inline double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
  return values[values.size() / 2];
}

}  // namespace imp::bench
