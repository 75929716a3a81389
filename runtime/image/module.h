// What imp_image.so offers: image files, encoded and decoded in memory. Plain C between the two sides,
// as the module is opened by name.
#pragma once

#include <cstddef>

namespace imp {

enum class PixelKind : unsigned char { byte, real };  // unsigned char (sRGB), float

struct RawImage {
  std::size_t width = 0, height = 0, channels = 0;
  const char* const* names = nullptr;  // of the channels
  PixelKind kind = PixelKind::byte;
  const void* pixels = nullptr;  // rows from the top, a pixel's channels side by side
};

// What takes the answer: a file's bytes.
using TakeBytes = void (*)(void* context, const char* bytes, std::size_t size);
// What takes an image that was read; it lives during the call.
using TakeImage = void (*)(void* context, const RawImage* image);

// `format` is "png" or "exr". On failure they return false, and `error` holds a message.
using EncodeImage = bool (*)(const char* format, const RawImage* image, TakeBytes take, void* context,
                             char* error, std::size_t error_size);
// PNG to bytes, all else to floats.
using DecodeImage = bool (*)(const char* path, TakeImage take, void* context, char* error,
                             std::size_t error_size);

inline constexpr char encode_image_name[] = "imp_encode_image";
inline constexpr char decode_image_name[] = "imp_decode_image";

}  // namespace imp
