// Beams: all rays of a tile at once, in slabs of depth, from coarse to fine.
//
// A tile is 64 x 64 pixels. Its beam is cut into 16 slabs; what is not excluded of it is cut again into 16 slabs
// for each cell of 16 x 16 pixels, and once more for each of 8 x 8. f and its derivative along the rays are enclosed
// over a whole slab (affine forms over two picture axes and the depth: Flórez, Sbert, Sainz and Vehí 2008 cast beams
// with interval methods), and tell of what class it is for every ray:
//
//    excluded, with the sign of f | empty: f has no value, or it is out of the domain | monotone: df/ds excludes 0 | unknown
//
// A last stage reads the classes front to back. A change of sign across monotone
// slabs is the first hit of every ray that has these slabs in its domain; equal signs are no root, and are left behind.
// Where the sign beside a monotone run is not known, or the domain ends in it, each ray looks at the ends by itself.
//
// Lanes are slabs, so no lane waits for another; a slab costs one enclosure for up to 4096 rays.
#pragma once

#include <optional>

#include "ir/stage.h"
#include "runtime/camera.h"
#include "runtime/render.h"

namespace imp {

// The stages before the pixels; none where beams can't be bounded (a domain that depends on parameters), and none
// for shaders.
// Errors as ray_function.
std::optional<Pipeline> beam_stages(const Model& model, const RenderOptions& options,
                                    Diagnostics& diagnostics);

// What the last of these stages tells of a surface for all rays of a cell of pixels. Depths are along the
// camera's axis; a ray is at depth z where it has gone z times as far as to depth 1.
struct Beam {
  Expr near;      // no ray has a root before it
  Expr far;       // nor behind it
  Expr run;       // in [near, far]: f is monotone along each ray from near to here
  Truth crosses;  // f changes its sign between them: the first hit of each ray that has both in the domain
  Expr sign;      // of f at near, if so
};

// The inputs of a pixel's Program that hold it, for surface `index` of those drawn.
Beam beam_inputs(Program& program, std::size_t index);

// The pixels of the cell they are for.
inline constexpr std::uint32_t beam_cell = 8;

}  // namespace imp
