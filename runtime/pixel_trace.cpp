#include "runtime/pixel_trace.h"

#include "runtime/pixel.h"
#include "runtime/view.h"

namespace imp {

std::optional<PixelTrace> trace_pixel(const Model& model, RenderOptions options,
                                      const UniformValues& uniforms, PixelPlace pixel,
                                      Diagnostics& diagnostics) {
  options.depth = options.normal = options.steps = options.ray = true;
  auto program = pixel_program(model, options, diagnostics);
  if (!program) return std::nullopt;

  PixelTrace result;
  result.program = lower(*std::move(program), options.kernel);
  const auto kernel = interpret(result.program, [&](const TraceStep& step) { result.steps.push_back(step); });

  const FrameInputs frame(model, uniforms, options.width, options.height);
  const std::map<std::string, float> place{{"x0", static_cast<float>(pixel.column)},
                                           {"y0", static_cast<float>(pixel.row)},
                                           {"column", 0.F},
                                           {"row", 0.F}};
  std::vector<const void*> in;
  for (const Input& input : result.program.inputs)
    in.push_back(input.rate == Rate::frame ? frame(input) : &place.at(input.name));
  std::vector<void*> out;
  for (const Output& output : result.program.outputs) out.push_back(&result.answer[output.name]);
  kernel->run({1, in, out});
  return result;
}

}  // namespace imp
