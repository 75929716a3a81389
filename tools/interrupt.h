// Interrupts end the command between writes and never within one, so that nothing half-written remains.
#pragma once

#include <mutex>

namespace imp::tools {

// From now on all signals that others send to end a process (but SIGKILL) wait for what `hold_interrupts` protects. To
// be called before any other thread is started.
void take_interrupts();

// While the lock lives, interrupts wait.
[[nodiscard]] std::unique_lock<std::mutex> hold_interrupts();

}  // namespace imp::tools
