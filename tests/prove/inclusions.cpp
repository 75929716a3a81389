#include "tests/prove/inclusions.h"

#include <algorithm>

#include "tests/prove/cores.h"
#include "tests/prove/rows.h"
#include "tests/support/inclusion_trial.h"

namespace imp::prove {
namespace {

constexpr std::uint64_t samples_at_once = 5000;

// Of every form that has a rule.
struct Counts {
  std::vector<test::InclusionCount> forms;

  void add(const Counts& other) {
    forms.resize(std::max(forms.size(), other.forms.size()));
    for (std::size_t i = 0; i < other.forms.size(); ++i) forms[i].add(other.forms[i]);
  }
};

std::string width(const test::InclusionCount& count) {
  if (count.width.total() == 0) return "?";
  const double median = count.width.median();
  return median < 1000 ? fmt::format("{:.3f}", median) : fmt::format("{:.2g}", median);
}

std::string row_text(const test::OpForm& op, Type type, std::uint64_t samples) {
  const test::InclusionTrial trial(op, imp::inclusions(), type);
  const auto all =
      on_all_cores<Counts>((samples + samples_at_once - 1) / samples_at_once,
                           [&](std::uint64_t i) { return Counts{trial.run(i, samples_at_once)}; });
  test::InclusionCount sum;
  std::string widths;
  std::size_t next = 0;
  for (const Inclusion& form : imp::inclusions()) {
    const bool known = next < trial.forms() && trial.form(next) == form.name;
    widths += " " + (known ? width(all.forms[next]) : "-") + " |";
    if (known) sum.add(all.forms[next++]);
  }
  if (!sum.first.empty()) fmt::print(stderr, "wrong, the first: {}\n", sum.first);
  const std::uint64_t wrong = sum.misses + sum.overclaimed;
  return fmt::format("| {} | {} | {} | {} | {} |{} {} |", op.name, type == f32 ? "float" : "double",
                     sum.boxes, sum.values, wrong, widths, wrong == 0 ? "holds" : "FAILS");
}

}  // namespace

bool inclusions(const InclusionOptions& options) {
  fmt::print("| op | type | boxes | values | wrong |");
  for (const Inclusion& form : imp::inclusions()) fmt::print(" {} |", form.name);
  fmt::print(" |\n| --- | --- | ---: | ---: | ---: |");
  for ([[maybe_unused]] const Inclusion& form : imp::inclusions()) fmt::print(" ---: |");
  fmt::print(" --- |\n");
  bool all_hold = true;
  for (const test::OpForm& op : test::op_forms()) {
    if (!options.only.empty() && std::ranges::find(options.only, op.name) == options.only.end()) continue;
    for (const Type type : {f32, f64}) {
      const std::string key = fmt::format("inclusion-{}-{}-{}-{}", op.name, to_text(type),
                                          imp::inclusions().size(), options.samples);
      all_hold &=
          row(options.done, key, [&] { return row_text(op, type, options.samples); }).ends_with("holds |");
    }
  }
  return all_hold;
}

}  // namespace imp::prove
