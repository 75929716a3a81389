// A team of threads that is kept between jobs. Made before a library is loaded elsewhere: starting a
// thread waits for a dlopen in progress, work on one that runs does not.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace imp {

class Workers {
 public:
  // 0: one a core. There are fewer where the machine starts no more.
  explicit Workers(unsigned threads = 0);
  ~Workers();

  // Runs `job` once in every thread, the caller's among them, and returns when all are done. One job
  // at a time: further callers wait.
  void run(const std::function<void()>& job);

  unsigned size() const { return static_cast<unsigned>(threads_.size()) + 1; }

 private:
  bool add_thread();  // false: the machine starts no more
  void serve();

  std::mutex one_job_;
  std::mutex mutex_;
  std::condition_variable changed_;
  const std::function<void()>* job_ = nullptr;
  std::size_t number_ = 0;   // of the job
  std::size_t working_ = 0;  // threads that have not finished it
  bool stop_ = false;
  std::vector<std::jthread> threads_;
};

}  // namespace imp
