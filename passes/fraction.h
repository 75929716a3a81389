// A function with poles as a fraction: 1/x + y = 0 is (1 + x y)/x = 0. Around a pole every enclosure is all numbers,
// and the sign changes where no zero is; the numerator knows of no pole.
#pragma once

#include <optional>

#include "ir/program.h"

namespace imp {

struct Fraction {
  Program numerator;             // with the inputs and the output of f
  std::optional<Program> poles;  // alike, 0 where a divisor is; nothing: all of f is the numerator
};

// `f` (f64, constants unresolved; the inputs x, y, z, then uniforms) over the fraction's bar. Wherever f has a value, so has the numerator, and where f
// is 0 it is. Where `poles` is defined and not 0 and the numerator is defined, f is numerator/d for a d that is continuous
// and not 0: there they have the same zeros. Taken apart are sums, products, whole powers and quotients down to divisors
// and tangents that change sign somewhere; elsewhere an enclosure tells a pole from a zero by itself.
Fraction fraction(const Program& f);

}  // namespace imp
