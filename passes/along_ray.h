// Composition along the ray: f(x, y, z) becomes f(o + s d), a function of s.
#pragma once

#include "ir/program.h"

namespace imp {

// `f` (f64; inputs x, y, z, then uniforms) as a Program with the inputs s, ox, oy, oz, dx, dy, dz
// (rate ray), then the uniforms; the outputs are those of `f`. (Knoll et al. 2009, eq. 3.)
Program along_ray(const Program& f);

}  // namespace imp
