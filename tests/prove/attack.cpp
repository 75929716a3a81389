#include "tests/prove/attack.h"

#include <chrono>
#include <set>

#include "tests/prove/cores.h"
#include "tests/support/attack.h"
#include "tests/support/minimise.h"

namespace imp::prove {
namespace {

using Clock = std::chrono::steady_clock;

// Each find as it comes, shortened; what is short and known is not printed again.
class Finds {
 public:
  explicit Finds(std::size_t tries) : tries_(tries) {}

  void report(const test::AttackCase& found, std::uint64_t seed) {
    const test::AttackCase shortest = test::minimised(found, tries_);
    const std::string text = to_text(shortest), answer = test::judged(shortest).text;
    const std::lock_guard lock(mutex_);
    if (known_.insert(text).second) fmt::print(stderr, "{}\n# seed {}: {}\n", text, seed, answer);
  }

 private:
  std::size_t tries_;
  std::mutex mutex_;
  std::set<std::string> known_;
};

}  // namespace

bool attack(const AttackTableOptions& options) {
  Finds finds(options.shrink);
  const auto round = [&](std::uint64_t number) {
    const std::uint64_t seed = options.seed * 1'000'003 + number;
    test::AttackTotal one = test::attack(seed);
    for (const test::AttackCase& wrong : one.wrong) finds.report(wrong, seed);
    one.wrong.clear();
    return one;
  };
  test::AttackTotal total;
  if (options.minutes <= 0) total = on_all_cores<test::AttackTotal>(options.rounds, round);
  constexpr std::uint64_t at_once = 64;
  const auto end = Clock::now() + std::chrono::duration<double, std::ratio<60>>(options.minutes);
  for (std::uint64_t first = 0; Clock::now() < end; first += at_once)
    total.add(on_all_cores<test::AttackTotal>(at_once, [&](std::uint64_t i) { return round(first + i); }));

  fmt::print("{} files, of which {} are refused\n\n", total.scenes, total.refused);
  fmt::print("| asked | tried | certified | proven right | not proven | wrong | |\n");
  fmt::print("| --- | ---: | ---: | ---: | ---: | ---: | --- |\n");
  bool holds = true;
  for (std::size_t i = 0; i < total.by.size(); ++i) {
    const test::AttackCount& c = total.by[i];
    holds &= c.wrong == 0;
    fmt::print("| {} | {} | {} | {} | {} | {} | {} |\n",
               i == 2   ? "pixels"
               : i == 1 ? "boxes"
                        : "rays",
               c.tried, c.certified, c.right, c.open, c.wrong, c.wrong == 0 ? "holds" : "FAILS");
  }
  return holds;
}

}  // namespace imp::prove
