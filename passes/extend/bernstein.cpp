#include "passes/polynomial/bernstein.h"
#include "ir/infinity.h"
#include "passes/extend/forms.h"

namespace imp {
namespace {

// What is wrong with f, and what would be right.
void refuse(const Diagnostics& reasons, Diagnostics& diagnostics) {
  for (const Diagnostic& reason : reasons.all())
    diagnostics.error(reason.span, reason.message + "; use --inclusion=auto");
}

}  // namespace

std::optional<std::vector<Interval>> bernstein_form(const Program& f, const InputBox& box,
                                                    Diagnostics& diagnostics) {
  auto* const coefficients = box.variables.size() == 1 ? bernstein_by_products : bernstein_by_samples;
  Diagnostics reasons;
  const auto outputs = coefficients(f, box, reasons);
  if (!outputs) {
    refuse(reasons, diagnostics);
    return std::nullopt;
  }

  const Expr all_reals = constant_like(box.sides[0].hi, infinity);
  Truth finite = truth_of(*all_reals.graph, true);
  for (const std::size_t i : box.variables) {
    const Interval& side = box.sides[i];
    if (!side.facts.bounded) finite = finite && side.nlo < all_reals && side.hi < all_reals;
  }
  std::vector<Interval> result;
  for (const Bernstein& output : *outputs) {
    Interval range = range_of(output.coefficients);
    range.nlo = select(finite, range.nlo, all_reals);
    range.hi = select(finite, range.hi, all_reals);
    result.push_back(range);
  }
  return result;
}

}  // namespace imp
