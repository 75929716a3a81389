// Programs for tables of points, boxes and rays. All their inputs are f64 with one value a row, so
// that the answer is for exactly the doubles in a file; uniforms are inputs like the others.
#pragma once

#include <optional>
#include <string_view>

#include "frontend/model.h"
#include "passes/extend/inclusion.h"
#include "runtime/options.h"
#include "runtime/search/search.h"

namespace imp {

enum class Evaluation : std::uint8_t { f, gradient, hessian, interval, affine, taylor, mean_value };

// By the name that `--program` takes; nothing for others.
std::optional<Evaluation> evaluation_named(std::string_view name);

// Whether boxes are evaluated, not points.
bool over_boxes(Evaluation evaluation);

// Points: inputs x, y, z and the uniforms; outputs f, or f fx fy fz, ….
// Boxes: inputs xlo, xhi, …; outputs flo, fhi, fdefined. `interval` is the natural extension, or `inclusion` if
// there is one; the others are what their names say.
std::optional<Program> evaluation_program(const Surface& surface, Evaluation evaluation, Type precision,
                                          Diagnostics& diagnostics, const Inclusion* inclusion = nullptr);

// Rays: inputs ox, oy, oz, dx, dy, dz, tmin, tmax and the uniforms; outputs verdict, t, nx, ny, nz,
// steps. Where nothing was found t is NaN; the normal has length 1 (NaN where f has no gradient).
std::optional<Program> cast_program(const Surface& surface, const Search& search, const Inclusion& inclusion,
                                    const SearchLimits& limits, Type precision, Diagnostics& diagnostics);

}  // namespace imp
