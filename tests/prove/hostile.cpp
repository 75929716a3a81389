#include "tests/prove/hostile.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "tests/support/hostile.h"

namespace imp::prove {

bool hostile(const HostileOptions& options) {
  constexpr double limit = 10;  // seconds
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  test::Hostile cases(options.seed);
  std::array<std::size_t, 3> exits{};
  std::size_t count = 0, by_signal = 0, findings = 0;
  double longest = 0;
  while (std::chrono::duration<double>(Clock::now() - start).count() < 60 * options.minutes) {
    const test::HostileCase each = cases.next();
    const test::HostileAnswer answer = test::run(each, limit);
    ++count;
    longest = std::max(longest, answer.seconds);
    if (answer.exit >= 0 && answer.exit <= 2) ++exits[static_cast<std::size_t>(answer.exit)];
    by_signal += answer.exit > 128;
    if (answer.problem.empty()) continue;
    ++findings;
    fmt::print("== case {} of seed {}: {}", count, options.seed, test::to_text(each, answer));
    std::fflush(stdout);
  }
  fmt::print(
      "| cases | fine | refused | usage | by a signal | longest | findings |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n"
      "| {} | {} | {} | {} | {} | {:.1f} s | {} |\n",
      count, exits[0], exits[1], exits[2], by_signal, longest, findings);
  return findings == 0;
}

}  // namespace imp::prove
