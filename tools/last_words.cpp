#include "tools/last_words.h"

#include <fcntl.h>
#include <gmp.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>

namespace imp::tools {
namespace {

// An exception would have to pass through code that knows none (LLVM, GMP) and through every thread, and unwinding
// takes memory itself. No file is half-written then: writing allocates nothing between open and rename.
[[noreturn]] void end_with(std::string_view message) {
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, message.data(), message.size());
  _exit(1);
}

[[noreturn]] void end_without_memory() { end_with("error: out of memory\n"); }

// The destructor of a library's thread, or an exception of one of its threads.
[[noreturn]] void end_of_a_library() { end_with("error: a library found no memory or no thread to go on\n"); }

void* checked(void* memory) { return memory ? memory : (end_without_memory(), nullptr); }

}  // namespace

void prepare_for_the_worst() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(file, F_GETFD) < 0)
      open("/dev/null", file == STDIN_FILENO ? O_WRONLY : O_RDONLY);  // takes its place
  std::set_new_handler(end_without_memory);
  std::set_terminate(end_of_a_library);
  mp_set_memory_functions(
      [](std::size_t size) { return checked(std::malloc(size)); },
      [](void* old, std::size_t, std::size_t size) { return checked(std::realloc(old, size)); }, nullptr);
}

}  // namespace imp::tools
