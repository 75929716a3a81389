// What a picture says pixel by pixel, with the rays of its pixels, so that each can be compared with the truth.
#pragma once

#include <map>

#include "runtime/pixel.h"
#include "runtime/view.h"
#include "tests/support/cast.h"

namespace imp::test {

struct PixelAnswer {
  Ray ray;  // from the eye, between the faces of the domain, in the picture's arithmetic
  Answer answer;
};

// Of every pixel, row by row, by the kernel that draws them; the reason where it is refused.
inline std::expected<std::vector<PixelAnswer>, std::string> pixel_answers(const Model& model,
                                                                          RenderOptions options) {
  Diagnostics diagnostics;
  options.depth = options.normal = options.steps = options.ray = true;
  auto program = pixel_program(model, options, diagnostics);
  const auto uniforms = uniform_values(model, {}, {}, diagnostics);
  if (!program || !uniforms) return std::unexpected(to_text(diagnostics));
  const auto kernel = kernel_of(*std::move(program), options.kernel);

  const std::size_t pixels = options.width * options.height;
  std::vector<float> columns(pixels), rows(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    columns[i] = static_cast<float>(i % options.width);
    rows[i] = static_cast<float>(i / options.width);
  }
  const float corner = 0;
  const std::map<std::string, const float*> places{
      {"x0", &corner}, {"y0", &corner}, {"column", columns.data()}, {"row", rows.data()}};
  const FrameInputs frame(model, *uniforms, options.width, options.height);
  std::vector<const void*> in;
  for (const Input& input : kernel->program().inputs)
    in.push_back(input.rate == Rate::frame ? frame(input) : places.at(input.name));
  std::map<std::string, std::vector<float>> channels;
  std::vector<void*> out;
  for (const Output& output : kernel->program().outputs) {
    auto& channel = channels[output.name];
    channel.resize(pixels);
    out.push_back(channel.data());
  }
  kernel->run({pixels, in, out});

  std::vector<PixelAnswer> result;
  for (std::size_t i = 0; i < pixels; ++i) {
    const auto at = [&](const char* name) { return static_cast<double>(channels.at(name)[i]); };
    result.push_back(
        {{{at("origin.x"), at("origin.y"), at("origin.z")},
          {at("direction.x"), at("direction.y"), at("direction.z")},
          at("near"),
          at("far")},
         {at("verdict"), at("depth"), {at("normal.x"), at("normal.y"), at("normal.z")}, at("steps")}});
  }
  return result;
}

// The ray and those as close to it as rounding in float may move it: a little at a time, as f may vary on the way.
inline std::vector<Ray> rays_beside(const Ray& ray) {
  std::vector<Ray> result{ray};
  const auto add = [&](auto change) { change(result.emplace_back(ray)); };
  for (const double sign : {-1.0, 1.0})
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double size = sign * (1 + std::abs(ray.o[axis]));
      for (int steps = 1; steps <= 32; ++steps) add([&](Ray& r) { r.o[axis] += steps * 0x1p-28 * size; });
      add([&](Ray& r) { r.o[axis] += 1e-6 * size; });
    }
  for (const double sign : {-1.0, 1.0}) {
    add([&](Ray& r) { r.tmin += sign * 1e-6 * ray.tmax; });
    add([&](Ray& r) { r.tmax += sign * 1e-6 * ray.tmax; });
  }
  return result;
}

}  // namespace imp::test
