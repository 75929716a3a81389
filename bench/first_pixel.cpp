// Where the time goes from the start of the process to the pixels of a small picture: the sphere at
// 64 x 64, nothing cached, by the command itself. A sum: how long a process takes that only says its version,
// and the stages that another one times.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <map>
#include <string>

#include "bench/tables.h"

namespace imp::bench {
namespace {

constexpr int rounds = 21;

// The output of a command and the milliseconds it took.
struct Run {
  std::string output;
  double milliseconds;
};

Run run(const std::string& command) {
  const auto start = std::chrono::steady_clock::now();
  std::FILE* pipe = popen(command.c_str(), "r");
  Run result{};
  if (pipe == nullptr) return result;
  for (char buffer[4096]; std::size_t got = std::fread(buffer, 1, sizeof buffer, pipe);)
    result.output.append(buffer, got);
  pclose(pipe);
  const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start;
  result.milliseconds = spent.count();
  return result;
}

}  // namespace

void print_first_pixel_table() {
  const std::string imp = IMP_COMMAND, file = std::string(IMP_SOURCE_DIR) + "/examples/surfaces/sphere.imp";
  const std::string render = imp + " render " + file + " --size 64x64 -o /dev/null.png --timings 2>&1";
  std::vector<std::string> order{"process"};
  std::map<std::string, std::vector<double>> times;
  std::vector<double> totals;
  for (int round = 0; round < rounds; ++round) {
    double total = run("exec " + imp + " --version").milliseconds;
    times["process"].push_back(total);
    const std::string text = run(render).output;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      char name[32];
      double milliseconds;
      if (std::sscanf(text.substr(at, end - at).c_str(), "%31[a-z ]%lf ms", name, &milliseconds) == 2) {
        std::string row = name;
        row.resize(row.find_last_not_of(' ') + 1);
        if (!times.contains(row)) order.push_back(row);
        times[row].push_back(milliseconds);
        if (row != "image") total += milliseconds;
      }
      at = end + 1;
    }
    totals.push_back(total);
  }
  fmt::print("The sphere at 64 x 64, medians of {} runs, nothing cached\n\n| what | ms |\n| --- | ---: |\n",
             rounds);
  for (const std::string& row : order)
    if (row != "image") fmt::print("| {} | {:.1f} |\n", row, median(times[row]));
  fmt::print("| **to the first pixel** | **{:.1f}** |\n", median(totals));
  fmt::print("| after it: the image library is loaded and writes | {:.1f} |\n", median(times["image"]));
}

}  // namespace imp::bench
