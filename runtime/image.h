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

// Whether `path` is a plain file, or none yet, also by way of links: it is then written under a temporary name beside
// it and renamed. All else is written into: "-" is standard output; a FIFO or a device stays what it is.
bool is_replaced(const std::string& path);

// That of `path`; ".png" for what is not replaced and has none.
std::string image_extension(const std::string& path);

// Why `path` can't be written, as far as that is known beforehand.
std::optional<std::string> problem_with_output(const std::string& path);

// Writes a .png (8 bits, channels R G B in linear light are encoded as sRGB; others are refused) or
// an .exr (float). A file that is replaced appears whole or not at all, and keeps its permissions. An error message
// on failure.
std::optional<std::string> write_image(const std::string& path, const Image& image);

}  // namespace imp
