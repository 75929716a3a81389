// The Program of a pixel: camera, domain, search, normal and shade in one kernel.
#pragma once

#include <optional>

#include "ir/stage.h"
#include "runtime/render.h"

namespace imp {

inline constexpr std::array background{1.0, 1.0, 1.0};  // the colour of a miss, linear

// The inputs of a stage (ir/stage.h), the frame inputs of runtime/view.h and the uniforms (f64);
// outputs, f32: red, green, blue (linear), verdict, and as asked depth, normal.x, normal.y,
// normal.z, steps; or, for `ray`, origin.x, …, direction.x, …, near, far: the ray, and where it
// enters and leaves the domain.
// `beams`: it is the last stage behind those of runtime/beam.h.
std::optional<Program> pixel_program(const Model& model, const RenderOptions& options,
                                     Diagnostics& diagnostics, bool beams = false);

// f as a picture sees it: what the domain decides is gone. f itself where the domain depends on parameters.
Program over_domain(const Model& model, const Program& f);

// That of a surface, simplified: what is searched, in beams and along rays.
Program drawn_function(const Model& model, std::size_t surface);

// The same; nothing, and an error, where it is so long that no search of it could be run.
std::optional<Program> searchable_function(const Model& model, std::size_t surface,
                                           const KernelOptions& options, Diagnostics& diagnostics);

// Of model.surfaces those that are drawn, by index.
std::vector<std::size_t> drawn_surfaces(const Model& model, const RenderOptions& options);

}  // namespace imp
