// OpenGL without a window: Mesa's OSMesa, loaded when it is first needed.
#pragma once

#include <array>
#include <cstdint>
#include <expected>
#include <functional>
#include <mutex>
#include <span>
#include <string>

#include "backends/glsl/gl.h"

namespace imp {

// The one context of the process. It is current only while it is in use, by one thread at a time, so it
// does not get in the way of others that use GL.
class GlContext {
 public:
  // Made by the first call, and never destroyed. Why there is none: what to install.
  static std::expected<GlContext*, std::string> get();

  // A program of one compute shader, compiled to machine code; or what the compiler says.
  std::expected<gl::Name, std::string> compile(const std::string& text);
  void remove(gl::Name program);

  // One invocation a ray for `rays` of them. `cells`, `in` and `out` are the buffers of
  // backends/glsl/layout.h.
  void dispatch(gl::Name program, std::uint32_t rays, std::span<const std::uint32_t> cells,
                std::span<const std::uint32_t> in, std::span<std::uint32_t> out);

 private:
  class Current;

  GlContext() = default;
  std::string open();  // empty, or why not
  std::expected<gl::Name, std::string> link(gl::Name shader);

  std::mutex mutex_;
  void* context_ = nullptr;
  unsigned char (*make_current_)(void*, void*, gl::Enum, int, int) = nullptr;
  gl::Functions gl_;
  std::array<gl::Name, 3> buffers_{};
};

}  // namespace imp
