#include "runtime/canvas.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>

#include "runtime/pixel.h"
#include "runtime/render.h"

namespace imp {
namespace {

// Where an output goes in a Picture.
struct Destination {
  std::vector<float>* channel;
  std::size_t stride, offset;
  float background;
};

std::map<std::string, Destination> destinations(Picture& picture) {
  constexpr float nowhere = std::numeric_limits<float>::infinity();
  const auto color = [&](std::size_t i) {
    return Destination{&picture.color, 3, i, static_cast<float>(background[i])};
  };
  return {{"red", color(0)},
          {"green", color(1)},
          {"blue", color(2)},
          {"verdict", {&picture.verdict, 1, 0, static_cast<float>(verdict_miss)}},
          {"depth", {&picture.depth, 1, 0, nowhere}},
          {"normal.x", {&picture.normal, 3, 0, 0}},
          {"normal.y", {&picture.normal, 3, 1, 0}},
          {"normal.z", {&picture.normal, 3, 2, 0}},
          {"steps", {&picture.steps, 1, 0, 0}}};
}

std::size_t place_of(const std::vector<Output>& outputs, std::string_view name) {
  return static_cast<std::size_t>(std::ranges::find(outputs, name, &Output::name) - outputs.begin());
}

}  // namespace

Canvas::Canvas(Picture& picture, const std::vector<Output>& outputs)
    : picture_(picture), verdict_(place_of(outputs, "verdict")), steps_(place_of(outputs, "steps")) {
  const auto all = destinations(picture);
  for (const auto& [name, unused] : all)
    if (place_of(outputs, name) == outputs.size()) unused.channel->clear();
  for (const Output& output : outputs) {
    const Destination& to = all.at(output.name);
    to.channel->resize(to.stride * picture.width * picture.height);
    float* const data = to.channel->data();
    channels_.push_back({data + to.offset, to.stride});
    auto plane = std::ranges::find(planes_, data, &Plane::data);
    if (plane == planes_.end())
      plane = planes_.insert(plane, {data, to.stride, std::vector<float>(to.stride * picture.width)});
    for (std::size_t i = to.offset; i < plane->background.size(); i += to.stride)
      plane->background[i] = to.background;
  }
}

void Canvas::draw(const PixelRows& pixels) {
  const std::vector<float>& verdicts = pixels.outputs[verdict_];
  if (std::ranges::find(verdicts, static_cast<float>(verdict_undecided)) != verdicts.end())
    note_undecided(pixels);
  constexpr std::size_t at_once = 256;
  std::array<std::size_t, at_once> from, to;  // pixels that lie in the picture
  for (std::size_t first = 0; first < pixels.count; first += at_once) {
    std::size_t count = 0;
    for (std::size_t i = first; i < std::min(pixels.count, first + at_once); ++i) {
      from[count] = i;
      to[count] = pixels.rows[i] * picture_.width + pixels.columns[i];
      count += pixels.columns[i] < picture_.width && pixels.rows[i] < picture_.height ? 1 : 0;
    }
    for (std::size_t k = 0; k < channels_.size(); ++k) {
      const Channel& channel = channels_[k];
      const float* values = pixels.outputs[k].data();
      for (std::size_t i = 0; i < count; ++i) channel.data[channel.stride * to[i]] = values[from[i]];
    }
  }
}

void Canvas::clear(std::size_t x, std::size_t y, std::size_t width, std::size_t height) {
  for (const Plane& plane : planes_)
    for (std::size_t row = y; row < y + height; ++row)
      std::copy_n(plane.background.begin(), plane.stride * width,
                  plane.data + plane.stride * (row * picture_.width + x));
}

void Canvas::note_undecided(const PixelRows& pixels) {
  const std::lock_guard lock(mutex_);
  for (std::size_t i = 0; i < pixels.count; ++i)
    if (pixels.outputs[verdict_][i] == static_cast<float>(verdict_undecided) &&
        pixels.columns[i] < picture_.width && pixels.rows[i] < picture_.height)
      undecided_.push_back(pixels.rows[i] * picture_.width + pixels.columns[i]);
}

Undecided Canvas::undecided() {
  std::ranges::sort(undecided_);  // they come from many threads
  Undecided pixels;
  for (const std::size_t place : undecided_) {
    pixels.columns.push_back(static_cast<std::uint32_t>(place % picture_.width));
    pixels.rows.push_back(static_cast<std::uint32_t>(place / picture_.width));
  }
  return pixels;
}

void Canvas::draw_decided(const PixelRows& pixels) {
  for (std::size_t i = 0; i < pixels.count; ++i) {
    const std::size_t place = pixels.rows[i] * picture_.width + pixels.columns[i];
    const bool decided = pixels.outputs[verdict_][i] != static_cast<float>(verdict_undecided);
    for (std::size_t k = 0; k < channels_.size(); ++k) {
      float& value = channels_[k].data[channels_[k].stride * place];
      if (k == steps_)
        value += pixels.outputs[k][i];
      else if (decided)
        value = pixels.outputs[k][i];
    }
  }
}

}  // namespace imp
