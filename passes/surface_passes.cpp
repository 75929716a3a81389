#include "passes/surface_passes.h"

#include "passes/horner.h"
#include "passes/reassociate.h"
#include "passes/recognize_chebyshev.h"

namespace imp {
namespace {

constexpr Pass surface[] = {
    {"recognize-chebyshev", Preserves::value, recognize_chebyshev},
    {"horner", Preserves::value, horner},
    {"reassociate", Preserves::value, reassociate},
};

}  // namespace

std::span<const Pass> surface_passes() { return surface; }

Program simplified(const Program& f, PassTrace* trace) { return run_passes(f, surface, trace); }

Fraction searched(const Program& f) {
  Fraction result = fraction(f);
  if (result.poles) result = {simplified(result.numerator), simplified(*result.poles)};
  return result;
}

}  // namespace imp
