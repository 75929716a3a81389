// What --stats and --timings print, to standard error.
#pragma once

#include <algorithm>
#include <chrono>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "runtime/kernel.h"
#include "runtime/method.h"
#include "tools/options.h"

namespace imp::tools {

class Stopwatch {
 public:
  double milliseconds() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

struct Verdicts {
  std::size_t hit = 0, miss = 0, undecided = 0;
};

struct Steps {
  double mean = 0, max = 0;
};
template <typename Number>
Steps steps_of(std::span<const Number> steps) {
  Steps result;
  for (const Number count : steps) {
    result.mean += static_cast<double>(count);
    result.max = std::max(result.max, static_cast<double>(count));
  }
  if (!steps.empty()) result.mean /= static_cast<double>(steps.size());
  return result;
}

struct Report {
  std::string_view things;  // what was answered: pixels, rays, points, boxes
  std::size_t count = 0;
  double milliseconds = 0;  // for these answers
  std::optional<Verdicts> verdicts;
  std::optional<Steps> steps;
  std::vector<Method> methods;  // how rays were searched, a surface each
};

// What --timings asks for.
void print(const Timings& timings, const Options& options);

// As far as the options ask for it.
void print(const Report& report, const Timings& timings, const Options& options);

}  // namespace imp::tools
