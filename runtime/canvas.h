// A picture while it is drawn: which output of a pixel's Program goes where.
#pragma once

#include <mutex>
#include <string>
#include <vector>

#include "ir/program.h"
#include "runtime/stages.h"

namespace imp {

struct Picture;

// Pixels of which nothing is certified.
struct Undecided {
  std::vector<std::uint32_t> columns, rows;
};

// Draws into a Picture with channels for these outputs, each pixel once at first. From many threads.
class Canvas {
 public:
  Canvas(Picture& picture, const std::vector<Output>& outputs);

  void draw(const PixelRows& pixels);
  void clear(std::size_t x, std::size_t y, std::size_t width, std::size_t height);  // to the background

  // The pixels drawn with an undecided verdict, in the order of the picture.
  Undecided undecided();

  // Over what is there, where the new verdict is not undecided; but the steps are added.
  void draw_decided(const PixelRows& pixels);

 private:
  void note_undecided(const PixelRows& pixels);

  struct Channel {
    float* data;
    std::size_t stride;  // between pixels
  };
  // Channels that lie together, pixel by pixel.
  struct Plane {
    float* data;
    std::size_t stride;
    std::vector<float> background;  // a row of it
  };

  const Picture& picture_;
  std::vector<Channel> channels_;  // an output each
  std::vector<Plane> planes_;
  std::size_t verdict_, steps_;  // the places of these two; past the end where there is none
  std::mutex mutex_;
  std::vector<std::size_t> undecided_;  // places in the picture
};

}  // namespace imp
