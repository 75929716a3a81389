// Rows of tables that take long: each is remembered in a file of its own, so a run can be stopped and
// taken up again.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

namespace imp::prove {

// The line `key`, from the folder `done` or else by `compute()`. A file is written under a
// temporary name and renamed, so that it is whole. The key holds all that the line depends on, but for the
// code: empty the folder when that changes. `done` may be empty: nothing is remembered.
template <class Compute>
std::string remembered(const std::string& done, const std::string& key, Compute compute) {
  const std::filesystem::path file = std::filesystem::path(done) / key;
  std::string text;
  if (std::ifstream known(file); done.empty() || !std::getline(known, text)) {
    text = compute();
    if (!done.empty()) {
      std::filesystem::create_directories(done);
      const std::string temporary = file.string() + ".new";
      std::ofstream(temporary) << text << '\n';
      std::filesystem::rename(temporary, file);
    }
  }
  return text;
}

// A row of a table, printed.
inline void print_row(const std::string& text) {
  fmt::print("{}\n", text);
  std::fflush(stdout);
}
template <class Compute>
std::string row(const std::string& done, const std::string& key, Compute compute) {
  std::string text = remembered(done, key, compute);
  print_row(text);
  return text;
}

}  // namespace imp::prove
