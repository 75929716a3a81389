#include "tests/prove/inclusions.h"

#include <algorithm>

#include "tests/prove/cores.h"
#include "tests/prove/rows.h"
#include "tests/support/inclusion_trial.h"

namespace imp::prove {
namespace {

constexpr std::uint64_t samples_at_once = 5000;

std::string row_text(const test::OpForm& op, const Inclusion& form, Type type, std::uint64_t samples) {
  const std::string head =
      fmt::format("| {} | {} | {} |", op.name, form.name, type == f32 ? "float" : "double");
  const test::InclusionTrial trial(op, {&form, 1}, type);
  if (trial.forms() == 0) return head + " | | | | | no rule |";
  const auto count =
      on_all_cores<test::InclusionCount>((samples + samples_at_once - 1) / samples_at_once,
                                         [&](std::uint64_t i) { return trial.run(i, samples_at_once)[0]; });
  if (!count.first.empty()) fmt::print(stderr, "wrong, the first: {}\n", count.first);
  const std::string width = count.width.total() == 0
                                ? " | |"
                                : fmt::format(" {:.3f} | {:.3g} |", count.width.median(), count.width.most());
  return fmt::format("{} {} | {} | {} |{} {} |", head, count.boxes, count.values,
                     count.misses + count.overclaimed, width,
                     count.misses + count.overclaimed == 0 ? "holds" : "FAILS");
}

}  // namespace

bool inclusions(const InclusionOptions& options) {
  fmt::print("| op | form | type | boxes | values | wrong | width, median | most | |\n");
  fmt::print("| --- | --- | --- | ---: | ---: | ---: | ---: | ---: | --- |\n");
  bool all_hold = true;
  for (const test::OpForm& op : test::op_forms()) {
    if (!options.only.empty() && std::ranges::find(options.only, op.name) == options.only.end()) continue;
    for (const Inclusion& form : imp::inclusions())
      for (const Type type : {f32, f64}) {
        const std::string key =
            fmt::format("inclusion-{}-{}-{}-{}", op.name, form.name, to_text(type), options.samples);
        all_hold &= !row(options.done, key, [&] {
                       return row_text(op, form, type, options.samples);
                     }).ends_with("FAILS |");
      }
  }
  return all_hold;
}

}  // namespace imp::prove
