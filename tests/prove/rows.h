// Rows of tables that take long: each is remembered in a file of its own, so a run can be stopped and
// taken up again.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

namespace imp::prove {

// The row `key`, from the folder `done` or else by `compute()`, printed. A file is written under a
// temporary name and renamed, so that it is whole. The key holds all that the row depends on, but for the
// code: empty the folder when that changes. `done` may be empty: nothing is remembered.
template <class Compute>
std::string row(const std::string& done, const std::string& key, Compute compute) {
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
  fmt::print("{}\n", text);
  std::fflush(stdout);
  return text;
}

}  // namespace imp::prove
