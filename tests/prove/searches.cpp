#include "tests/prove/searches.h"

#include <map>
#include <ranges>
#include <sstream>
#include <stdexcept>

#include "tests/prove/cores.h"
#include "tests/prove/rows.h"
#include "tests/support/judge.h"
#include "tests/support/random_rays.h"
#include "tests/support/ways.h"

namespace imp::prove {
namespace {

using test::Judgement;

constexpr std::size_t rays_at_once = 200;  // rays

// The answers of one way to search, counted.
struct Count {
  std::uint64_t hits = 0, misses = 0, wrong = 0, doubtful = 0,
                undecided = 0;  // of the first two those that are right
  std::uint64_t easy = 0, easy_decided = 0;
  std::uint64_t surfaces = 0;

  void add(const Count& other) {
    hits += other.hits, misses += other.misses, wrong += other.wrong, doubtful += other.doubtful;
    undecided += other.undecided, easy += other.easy, easy_decided += other.easy_decided;
    surfaces += other.surfaces;
  }

  // As it is remembered.
  static Count read(const std::string& text) {
    Count c;
    std::istringstream(text) >> c.surfaces >> c.hits >> c.misses >> c.wrong >> c.doubtful >> c.undecided >>
        c.easy >> c.easy_decided;
    return c;
  }
  std::string text() const {
    return fmt::format("{} {} {} {} {} {} {} {}", surfaces, hits, misses, wrong, doubtful, undecided, easy,
                       easy_decided);
  }
};

struct Trial {
  test::Ray ray;
  test::DenseRoots known;
};

struct Trials {
  std::map<std::size_t, std::vector<Trial>> batches;
  void add(Trials other) { batches.merge(other.batches); }
};

// A surface, its rays, and what is true of them.
class Bench {
 public:
  Bench(const test::SurfaceEntry& entry, std::size_t rays) : model_(test::model_of(entry)), judge_(model_) {
    trials_ = on_all_cores<Trials>((rays + rays_at_once - 1) / rays_at_once, [&](std::uint64_t number) {
      test::RandomRays random(entry.domain, number);
      std::vector<Trial> trials;
      for (std::size_t i = number * rays_at_once; i < std::min(rays, (number + 1) * rays_at_once); ++i) {
        const test::Ray ray = random.next(judge_.dense());
        trials.push_back({ray, judge_.roots(ray)});
      }
      return Trials{{{number, std::move(trials)}}};
    });
  }

  Count cast(const test::Way& way) const {
    const auto caster = test::caster(model_, way);
    if (!caster) return {};
    Count total = on_all_cores<Count>(trials_.batches.size(), [&](std::uint64_t number) {
      const auto& trials = trials_.batches.at(number);
      std::vector<test::Ray> rays;
      for (const Trial& trial : trials) rays.push_back(trial.ray);
      const auto answers = (*caster)(rays);
      Count count;
      for (std::size_t i = 0; i < rays.size(); ++i) count.add(counted(way, trials[i], answers[i]));
      return count;
    });
    total.surfaces = 1;
    return total;
  }

 private:
  Count counted(const test::Way& way, const Trial& trial, const test::Answer& answer) const {
    const Judgement judgement = judge_(trial.ray, trial.known, answer);
    const bool right = judgement == Judgement::right, hit = answer.verdict == verdict_hit;
    if (judgement == Judgement::wrong)
      fmt::print(stderr, "{}, {}: {} for the ray {}\n", model_.surfaces[0].name, way.name(),
                 hit ? fmt::format("hit at {}", answer.t) : "miss", test::to_text(trial.ray));
    Count count;
    count.hits = right && hit, count.misses = right && !hit;
    count.wrong = judgement == Judgement::wrong, count.doubtful = judgement == Judgement::doubtful;
    count.undecided = judgement == Judgement::undecided;
    count.easy = trial.known.easy, count.easy_decided = trial.known.easy && right;
    return count;
  }

  Model model_;
  test::Judge judge_;
  Trials trials_;
};

std::string percent(const Count& count) {
  if (count.surfaces == 0) return "-";
  if (count.easy == 0) return "none easy";
  // Rounded down: 100 is all of them.
  const double share = 1000.0 * static_cast<double>(count.easy_decided) / static_cast<double>(count.easy);
  return fmt::format("{:.1f}", std::floor(share) / 10);
}

void print_by_way(const std::vector<test::Way>& ways, const std::vector<Count>& totals) {
  fmt::print(
      "\n| strategy | inclusion | type | surfaces | right hits | right misses | wrong | in doubt | undecided "
      "| ");
  fmt::print(
      "easy rays decided, % | |\n| --- | --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | --- "
      "|\n");
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const Count& c = totals[i];
    print_row(fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |", ways[i].search->name,
                          ways[i].inclusion->name, ways[i].precision == f32 ? "float" : "double", c.surfaces,
                          c.hits, c.misses, c.wrong, c.doubtful, c.undecided, percent(c),
                          c.wrong == 0 ? "holds" : "FAILS"));
  }
}

}  // namespace

bool searches(const SearchOptions& options) {
  const auto tried = [&](const Search& search) {
    return options.strategies.empty() ||
           std::ranges::find(options.strategies, search.name) != options.strategies.end();
  };
  std::vector<test::Way> ways;
  for (const std::string& inclusion : options.inclusions)
    for (const test::Way& way : test::every_way({inclusion}))
      if (tried(*way.search) && (!way.search->by_coefficients || inclusion == options.inclusions.front()))
        ways.push_back(way);
  if (ways.empty()) throw std::runtime_error("no such strategy");
  std::vector<Count> totals(ways.size());
  const auto in_first_table = [&](const test::Way& way) { return way.inclusion == ways.front().inclusion; };

  fmt::print("Easy rays decided, %, float / double, with the inclusion {}\n\n| surface | easy rays |",
             ways.front().inclusion->name);
  std::string rule;
  for (const Search& search : imp::searches() | std::views::filter(tried))
    fmt::print(" {} |", search.name), rule += " ---: |";
  fmt::print(" wrong | |\n| --- | ---: |{}", rule);
  fmt::print(" ---: | --- |\n");

  for (const test::SurfaceEntry& entry : test::catalogue()) {
    if (!options.only.empty() && std::ranges::find(options.only, entry.id) == options.only.end()) continue;
    std::optional<Bench> bench;  // made where something is not yet known
    std::string cells;
    Count all;
    for (std::size_t i = 0; i < ways.size(); ++i) {
      const test::Way& way = ways[i];
      const std::string key = fmt::format("search-{}-{}-{}-{}-{}", entry.id, way.search->name,
                                          way.inclusion->name, to_text(way.precision), options.rays);
      const Count count = Count::read(remembered(options.done, key, [&] {
        if (!bench) bench.emplace(entry, options.rays);
        return bench->cast(way).text();
      }));
      totals[i].add(count);
      all.wrong += count.wrong, all.easy = std::max(all.easy, count.easy);
      if (in_first_table(way))
        cells += fmt::format("{}{}", way.precision == f32 ? " " : " / ", percent(count));
      if (in_first_table(way) && way.precision == f64) cells += " |";
    }
    print_row(fmt::format("| {} | {} |{} {} | {} |", entry.id, all.easy, cells, all.wrong,
                          all.wrong == 0 ? "holds" : "FAILS"));
  }
  print_by_way(ways, totals);
  return std::ranges::all_of(totals, [](const Count& count) { return count.wrong == 0; });
}

}  // namespace imp::prove
