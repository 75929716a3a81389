#include "runtime/workers.h"

#include <algorithm>
#include <system_error>

namespace imp {

Workers::Workers(unsigned threads) {
  if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
  while (threads_.size() + 1 < threads && add_thread()) {}
}

bool Workers::add_thread() {
  try {
    threads_.emplace_back([this] { serve(); });
    return true;
  } catch (const std::system_error&) { return false; }
}

Workers::~Workers() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
}

void Workers::run(const std::function<void()>& job) {
  const std::lock_guard alone(one_job_);
  {
    const std::lock_guard lock(mutex_);
    job_ = &job;
    working_ = threads_.size();
    ++number_;
  }
  changed_.notify_all();
  job();
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return working_ == 0; });
}

void Workers::serve() {
  std::size_t done = 0;
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return stop_ || number_ != done; });
    if (stop_) return;
    done = number_;
    const auto& job = *job_;
    lock.unlock();
    job();
    lock.lock();
    if (--working_ == 0) changed_.notify_all();
  }
}

}  // namespace imp
