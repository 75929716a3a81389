// Work on all cores.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

namespace imp::prove {

// The sum, by add(), of `measure(number)` for all numbers below `count`.
template <class Total, class Measure>
Total on_all_cores(std::uint64_t count, Measure measure) {
  Total total;
  std::mutex mutex;
  std::atomic<std::uint64_t> next = 0;
  const auto work = [&] {
    Total mine;
    for (std::uint64_t i = next++; i < count; i = next++) mine.add(measure(i));
    const std::lock_guard lock(mutex);
    total.add(mine);
  };
  std::vector<std::jthread> threads;
  for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) threads.emplace_back(work);
  work();
  threads.clear();
  return total;
}

}  // namespace imp::prove
