// Reads pictures back, through the module that writes them.
#pragma once

#include <dlfcn.h>

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "runtime/image/module.h"

namespace imp::test {

struct DecodedImage {
  std::size_t width = 0, height = 0;
  std::vector<std::string> names;
  std::vector<float> values;  // a pixel's channels side by side; bytes are 0 to 255

  float at(std::size_t x, std::size_t y, const std::string& name) const {
    for (std::size_t c = 0; c < names.size(); ++c)
      if (names[c] == name) return values[(y * width + x) * names.size() + c];
    ADD_FAILURE() << "no channel " << name;
    return 0;
  }
};

inline DecodedImage decode_image(const std::string& path) {
  const auto place = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "imp_image.so";
  void* module = dlopen(place.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!module) {
    ADD_FAILURE() << dlerror();
    return {};
  }
  const auto decode = reinterpret_cast<DecodeImage>(dlsym(module, decode_image_name));
  DecodedImage decoded;
  const auto take = [](void* context, const RawImage* image) {
    auto& result = *static_cast<DecodedImage*>(context);
    result.width = image->width;
    result.height = image->height;
    result.names.assign(image->names, image->names + image->channels);
    for (std::size_t i = 0; i < image->width * image->height * image->channels; ++i)
      result.values.push_back(image->kind == PixelKind::real
                                  ? static_cast<const float*>(image->pixels)[i]
                                  : static_cast<const unsigned char*>(image->pixels)[i]);
  };
  char error[512] = "";
  EXPECT_TRUE(decode(path.c_str(), take, &decoded, error, sizeof error)) << path << ": " << error;
  return decoded;
}

}  // namespace imp::test
