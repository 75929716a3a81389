#include "tools/interrupt.h"

#include <csignal>
#include <thread>

namespace imp::tools {
namespace {

std::mutex& writing() {
  static auto* mutex = new std::mutex;  // never destroyed: the watching thread is never joined
  return *mutex;
}

bool is_ignored(int signal) {
  struct sigaction now{};
  return sigaction(signal, nullptr, &now) == 0 && now.sa_handler == SIG_IGN;
}

void watch(sigset_t signals) {
  int signal = 0;
  if (sigwait(&signals, &signal) != 0) return;
  const std::scoped_lock between_writes(writing());
  std::signal(signal, SIG_DFL);
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
  std::raise(signal);
}

}  // namespace

void take_interrupts() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGUSR1, SIGUSR2, SIGALRM, SIGTERM, SIGVTALRM, SIGPROF,
                           SIGXCPU, SIGIO, SIGPWR, SIGSTKFLT})
    if (!is_ignored(signal)) sigaddset(&signals, signal);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::thread(watch, signals).detach();
}

std::unique_lock<std::mutex> hold_interrupts() { return std::unique_lock(writing()); }

}  // namespace imp::tools
