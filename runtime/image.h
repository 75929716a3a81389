// Images on disk, through OpenImageIO, which is a module loaded when first needed.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace imp {

struct Channel {
  std::string name;               // R, G, B, depth.Z, normal.X, verdict, …
  std::span<const float> values;  // the first value of the first pixel
  std::size_t stride;             // from pixel to pixel, in values
};

struct Image {
  std::size_t width = 0, height = 0;
  std::vector<Channel> channels;
};

// Starts to load the module in another thread, so that it is there when a picture is done.
void preload_image_module();

// Writes a .png (8 bits, channels R G B in linear light are encoded as sRGB; others are refused) or
// an .exr (float). The file appears whole or not at all: it is written under a temporary name beside
// `path` and renamed; "-" writes a .png to standard output. An error message on failure.
std::optional<std::string> write_image(const std::string& path, const Image& image);

}  // namespace imp
