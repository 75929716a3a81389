// The verbs of the command: each adds its options to a parser and returns what to do once they are read.
#pragma once

#include <functional>

#include <CLI/CLI.hpp>

namespace imp::tools {

// What a command answers to the shell.
enum Exit : int {
  fine = 0,
  failed = 1,  // the input is wrong, or an output can't be written
  misused = 2,
};

using Action = std::function<Exit()>;

Action add_render(CLI::App& verb);
Action add_eval(CLI::App& verb);
Action add_cast(CLI::App& verb);
Action add_check(CLI::App& verb);
Action add_list(CLI::App& verb);
Action add_inspect(CLI::App& verb);
Action add_trace(CLI::App& verb);

}  // namespace imp::tools
