// Files that appear whole or not at all, and the module that knows their formats.
#include "runtime/image.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <linux/magic.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cfenv>
#include <cmath>
#include <cstring>
#include <expected>
#include <filesystem>
#include <future>
#include <system_error>

#include <fmt/format.h>

#include "runtime/image/module.h"

namespace imp {
namespace {

namespace fs = std::filesystem;

using Error = std::optional<std::string>;

// The module.

using Module = std::expected<EncodeImage, std::string>;

std::vector<fs::path> module_places() {
  std::error_code ignored;
  const fs::path executable = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  return {executable / "imp_image.so", executable / "../lib/imp/imp_image.so"};
}

// A library behind the module starts threads while it is loaded, and waits for ever where one of them cannot start.
bool has_room_for_module() {
  constexpr std::size_t enough = 640 << 20;  // of address space; libraries and stacks take 540 MiB
  void* const room = mmap(nullptr, enough, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (room == MAP_FAILED) return false;
  munmap(room, enough);
  return true;
}

Module load_module() {
  if (!has_room_for_module())
    return std::unexpected("no module for images: too little memory is left to load it");
  // A library that was compiled for speed alone may set the thread to flush denormals when it is loaded.
  std::fenv_t environment;
  std::fegetenv(&environment);
  void* module = nullptr;
  std::string problem;
  for (const fs::path& place : module_places()) {
    if (!fs::exists(place)) continue;
    module = dlopen(place.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (module) break;
    problem = dlerror();
  }
  std::fesetenv(&environment);

  if (!module && problem.empty())
    problem = fmt::format("neither '{}' nor '{}' is there", module_places()[0].string(),
                          module_places()[1].lexically_normal().string());
  if (!module) return std::unexpected("no module for images: " + problem);
  void* encode = dlsym(module, encode_image_name);
  if (!encode) return std::unexpected(fmt::format("no module for images: {}", dlerror()));
  return reinterpret_cast<EncodeImage>(encode);
}

// Loaded once, in a thread of its own that the first call starts.
const std::shared_future<Module>& image_module() {
  static const std::shared_future<Module> module = [] {
    try {
      return std::async(std::launch::async, load_module).share();
    } catch (const std::system_error&) {  // no further thread: later, and in the caller's
      return std::async(std::launch::deferred, load_module).share();
    }
  }();
  return module;
}

// Encoding.

// Linear light to the 8 bits of sRGB (IEC 61966-2-1); what is no number is black.
unsigned char srgb(float linear) {
  if (!(linear > 0)) return 0;
  if (linear >= 1) return 255;
  const float encoded = linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
  return static_cast<unsigned char>(std::lround(255 * encoded));
}

// The same by a table of the largest linear value of each code: exact, and 20 times quicker.
class SrgbTable {
 public:
  SrgbTable() {
    for (std::size_t code = 1; code < above_.size(); ++code) {
      float low = 0, high = 1;  // srgb(low) < code <= srgb(high)
      for (;;) {
        const float middle = low + (high - low) / 2;
        if (middle <= low || middle >= high) break;
        (srgb(middle) < code ? low : high) = middle;
      }
      above_[code] = high;
    }
  }
  unsigned char operator()(float linear) const {
    const auto after = std::upper_bound(above_.begin() + 1, above_.end(), linear,
                                        [](float value, float bound) { return !(value >= bound); });
    return static_cast<unsigned char>(after - above_.begin() - 1);
  }

 private:
  std::array<float, 256> above_{};  // the least linear value that has at least this code
};

template <typename Value, typename Convert>
std::vector<Value> interleaved(const Image& image, Convert convert) {
  const std::size_t count = image.channels.size();
  std::vector<Value> pixels(image.width * image.height * count);
  for (std::size_t c = 0; c < count; ++c) {
    const Channel& channel = image.channels[c];
    for (std::size_t i = 0; i < image.width * image.height; ++i)
      pixels[i * count + c] = convert(channel.values[i * channel.stride]);
  }
  return pixels;
}

using Bytes = std::string;

std::expected<Bytes, std::string> encoded(EncodeImage encode, const char* format, const Image& image,
                                          PixelKind kind, const void* pixels) {
  std::vector<const char*> names;
  names.reserve(image.channels.size());
  for (const Channel& channel : image.channels) names.push_back(channel.name.c_str());
  const RawImage raw{image.width, image.height, names.size(), names.data(), kind, pixels};
  Bytes bytes;
  const auto take = [](void* context, const char* data, std::size_t size) {
    static_cast<Bytes*>(context)->assign(data, size);
  };
  char error[512] = "";
  if (!encode(format, &raw, take, &bytes, error, sizeof error)) return std::unexpected(std::string(error));
  return bytes;
}

bool is_color(const Image& image) {
  return image.channels.size() == 3 && image.channels[0].name == "R" && image.channels[1].name == "G" &&
         image.channels[2].name == "B";
}

std::expected<Bytes, std::string> file_bytes(const Image& image, std::string_view extension) {
  if (extension != ".png" && extension != ".exr")
    return std::unexpected(fmt::format("no format '{}'; there are .png and .exr", extension));
  if (extension == ".png" && !is_color(image))
    return std::unexpected("a .png holds R, G and B; .exr holds any channels");
  const Module& module = image_module().get();
  if (!module) return std::unexpected(module.error());
  if (extension == ".png") {
    const SrgbTable table;
    return encoded(*module, "png", image, PixelKind::byte, interleaved<unsigned char>(image, table).data());
  }
  return encoded(*module, "exr", image, PixelKind::real,
                 interleaved<float>(image, [](float value) { return value; }).data());
}

// Writing.

Error write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return std::strerror(errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return std::nullopt;
}

Error closed(int file, Error error) {
  if (close(file) != 0 && !error) error = std::strerror(errno);
  return error;
}

// Under a name of its own beside `path`, then renamed. What was there before leaves its permissions.
Error write_whole(const fs::path& path, std::string_view bytes) {
  struct stat before{};
  const bool known = stat(path.c_str(), &before) == 0;
  if (known && access(path.c_str(), W_OK) != 0) return std::strerror(errno);
  const fs::path temporary =
      path.parent_path() / fmt::format(".{}.{}.part", path.filename().string(), getpid());
  const int file = open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file < 0) return std::strerror(errno);
  Error error = write_all(file, bytes);
  if (known && !error && fchmod(file, before.st_mode & 0777) != 0) error = std::strerror(errno);
  if (!error && fsync(file) != 0 && errno != EINVAL && errno != EROFS) error = std::strerror(errno);
  error = closed(file, std::move(error));
  if (!error && std::rename(temporary.c_str(), path.c_str()) != 0) error = std::strerror(errno);
  if (error) unlink(temporary.c_str());
  return error;
}

// What is no plain file stays what it is. Behind what is there already, as a shell's >> would: /dev/stdout may be
// a file that others write too.
Error write_into(const fs::path& path, std::string_view bytes) {
  const int file = open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC | O_NOCTTY);
  if (file < 0) return std::strerror(errno);
  return closed(file, write_all(file, bytes));
}

// Where links lead, be it to nothing yet; a link in /proc stands for what is open, and has no place.
fs::path without_links(fs::path path) {
  std::error_code ignored;
  for (int hops = 0; hops < 40 && fs::is_symlink(path, ignored); ++hops) {
    struct statfs system{};
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    if (statfs(folder.c_str(), &system) == 0 && system.f_type == PROC_SUPER_MAGIC) return path;
    path = folder / fs::read_symlink(path, ignored);
  }
  return path;
}

Error problem_with_folder(const fs::path& path) {
  const fs::path folder = path.parent_path();
  if (access(folder.empty() ? "." : folder.c_str(), W_OK | X_OK) == 0) return std::nullopt;
  return std::strerror(errno);
}

Error cannot_write(const std::string& path, const Error& error) {
  if (!error) return std::nullopt;
  return fmt::format("cannot write {}: {}", path == "-" ? "to standard output" : "'" + path + "'", *error);
}

}  // namespace

void preload_image_module() { image_module(); }

bool is_replaced(const std::string& path) {
  if (path == "-") return false;
  std::error_code ignored;
  const fs::path target = without_links(path);
  const fs::file_status status = fs::symlink_status(target, ignored);
  return !fs::exists(status) || fs::is_regular_file(status);
}

std::string image_extension(const std::string& path) {
  const std::string extension = path == "-" ? "" : fs::path(path).extension().string();
  return extension.empty() && !is_replaced(path) ? ".png" : extension;
}

std::optional<std::string> problem_with_output(const std::string& path) {
  if (path == "-") return std::nullopt;
  if (is_replaced(path)) return cannot_write(path, problem_with_folder(without_links(path)));
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) return cannot_write(path, std::strerror(EISDIR));
  return cannot_write(path, access(path.c_str(), W_OK) == 0 ? std::nullopt : Error(std::strerror(errno)));
}

std::optional<std::string> write_image(const std::string& path, const Image& image) {
  const auto bytes = file_bytes(image, image_extension(path));
  if (!bytes) return cannot_write(path, bytes.error());
  if (path == "-") return cannot_write(path, write_all(STDOUT_FILENO, *bytes));
  return cannot_write(
      path, is_replaced(path) ? write_whole(without_links(path), *bytes) : write_into(path, *bytes));
}

}  // namespace imp
