// imp_image.so: OpenImageIO behind two C functions. It works in memory, so that files are written in one
// place, and whole.
#include "runtime/image/module.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <exception>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace {

using namespace imp;

struct Failure {
  char* text;
  std::size_t size;

  bool operator()(std::string_view message) const {
    if (size > 0) *fmt::format_to_n(text, size - 1, "{}", message).out = '\0';
    return false;
  }
};

OIIO::TypeDesc type_of(PixelKind kind) {
  return kind == PixelKind::byte ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT;
}

OIIO::ImageSpec spec_of(const RawImage& image) {
  const auto size = [](std::size_t n) { return static_cast<int>(n); };
  OIIO::ImageSpec spec(size(image.width), size(image.height), size(image.channels), type_of(image.kind));
  spec.channelnames.assign(image.names, image.names + image.channels);
  spec.attribute("oiio:ColorSpace", image.kind == PixelKind::byte ? "sRGB" : "Linear");
  spec.attribute("DateTime", "");             // equal pictures are equal files
  spec.attribute("png:compressionLevel", 3);  // with differences to the left pixel: a third of the time
  spec.attribute("png:filter", 16);           // of the default, a sixth more bytes
  spec.attribute("compression", image.kind == PixelKind::byte ? "default" : "zip");
  return spec;
}

bool encode(const char* format, const RawImage& image, TakeBytes take, void* context, Failure failure) {
  const auto output = OIIO::ImageOutput::create(format);
  if (!output) return failure(OIIO::geterror());
  OIIO::Filesystem::IOVecOutput bytes;
  if (!output->supports("ioproxy") || !output->set_ioproxy(&bytes))
    return failure(fmt::format("OpenImageIO cannot write {} into memory", format));
  const bool written = output->open(std::string("memory.") + format, spec_of(image)) &&
                       output->write_image(type_of(image.kind), image.pixels) && output->close();
  if (!written) return failure(output->geterror());
  const auto& buffer = bytes.buffer();
  take(context, reinterpret_cast<const char*>(buffer.data()), buffer.size());
  return true;
}

bool decode(const char* path, TakeImage take, void* context, Failure failure) {
  const auto input = OIIO::ImageInput::open(path);
  if (!input) return failure(OIIO::geterror());
  const OIIO::ImageSpec& spec = input->spec();
  const bool bytes = spec.format == OIIO::TypeDesc::UINT8;
  RawImage image;
  image.width = static_cast<std::size_t>(spec.width);
  image.height = static_cast<std::size_t>(spec.height);
  image.channels = static_cast<std::size_t>(spec.nchannels);
  image.kind = bytes ? PixelKind::byte : PixelKind::real;
  std::vector<const char*> names;
  names.reserve(spec.channelnames.size());
  for (const std::string& name : spec.channelnames) names.push_back(name.c_str());
  image.names = names.data();
  std::vector<float> pixels(image.width * image.height * image.channels);  // for bytes more than enough
  if (!input->read_image(0, 0, 0, spec.nchannels, type_of(image.kind), pixels.data()))
    return failure(input->geterror());
  image.pixels = pixels.data();
  take(context, &image);
  return true;
}

// No exception may leave the module.
template <typename Work>
bool guarded(Failure failure, Work work) {
  try {
    return work();
  } catch (const std::exception& problem) { return failure(problem.what()); }
}

}  // namespace

extern "C" {

[[gnu::visibility("default")]] bool imp_encode_image(const char* format, const imp::RawImage* image,
                                                     imp::TakeBytes take, void* context, char* error,
                                                     std::size_t error_size) {
  const Failure failure{error, error_size};
  return guarded(failure, [&] { return encode(format, *image, take, context, failure); });
}

[[gnu::visibility("default")]] bool imp_decode_image(const char* path, imp::TakeImage take, void* context,
                                                     char* error, std::size_t error_size) {
  const Failure failure{error, error_size};
  return guarded(failure, [&] { return decode(path, take, context, failure); });
}

}  // extern "C"
