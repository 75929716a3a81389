// What the search did for one pixel: the pixel's Program, run step by step by the interpreter.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runtime/render.h"

namespace imp {

struct PixelPlace {
  std::size_t column = 0, row = 0;  // from the upper left
};

struct PixelTrace {
  Program program;                      // what ran: its phases name the states of the steps
  std::vector<TraceStep> steps;         // phase by phase, in order
  std::map<std::string, float> answer;  // every output of pixel_program, with all that can be asked for
};

// The same bits as the picture has there, whatever backend made it; `options` says of which picture,
// and its channels don't matter. Errors as for a picture.
std::optional<PixelTrace> trace_pixel(const Model& model, RenderOptions options,
                                      const UniformValues& uniforms, PixelPlace pixel,
                                      Diagnostics& diagnostics);

}  // namespace imp
