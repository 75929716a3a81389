#include "backends/glsl/context.h"

#include <dlfcn.h>

#include <algorithm>
#include <cfenv>

#include "backends/float_mode.h"
#include "backends/glsl/emit.h"
#include "ir/assert.h"

namespace imp {
namespace {

constexpr const char* library_name = "libOSMesa.so.8";

// Of GL/osmesa.h.
constexpr int rgba = 0x1908;
constexpr gl::Enum unsigned_byte = 0x1401;
constexpr int core_profile_4_5[] = {0x22, rgba,  // OSMESA_FORMAT, OSMESA_RGBA
                                    0x33, 0x34,  // OSMESA_PROFILE, OSMESA_CORE_PROFILE
                                    0x36, 4,     // OSMESA_CONTEXT_MAJOR_VERSION
                                    0x37, 5,     // OSMESA_CONTEXT_MINOR_VERSION
                                    0};

template <class T>
void find(void* library, const char* name, T*& function) {
  function = reinterpret_cast<T*>(dlsym(library, name));
}

// What the compiler says of a shader or a program, without the last newline.
std::string log_of(gl::Name name, void (*get)(gl::Name, int, int*, char*)) {
  std::string log(4096, '\0');
  int length = 0;
  get(name, static_cast<int>(log.size()), &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  while (log.ends_with('\n')) log.pop_back();
  return log;
}

}  // namespace

// Makes the context current for as long as it lives, and rounding what Mesa takes for granted: it folds
// constants in this thread, and its own threads inherit the mode of the one that makes the context.
class GlContext::Current {
 public:
  explicit Current(GlContext& context) : lock_(context.mutex_), mode_(FE_TONEAREST), context_(context) {
    const bool made = context.make_current_(context.context_, pixel_, unsigned_byte, 1, 1) != 0;
    IMP_ASSERT(made, "a context that can be made current");
  }
  ~Current() { context_.make_current_(nullptr, nullptr, unsigned_byte, 0, 0); }
  Current(const Current&) = delete;
  Current& operator=(const Current&) = delete;

 private:
  std::lock_guard<std::mutex> lock_;
  FloatMode mode_;
  GlContext& context_;
  unsigned char pixel_[4]{};
};

std::expected<GlContext*, std::string> GlContext::get() {
  static GlContext& context = *new GlContext;  // Mesa's threads live until the process ends
  static const std::string why_not = context.open();
  if (!why_not.empty()) return std::unexpected(why_not);
  return &context;
}

std::string GlContext::open() {
  const FloatMode mode(FE_TONEAREST);
  void* library = dlopen(library_name, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr)
    return std::string("there is no ") + library_name +
           "; install the package libosmesa6, or use --backend=llvm";
  void* (*create)(const int*, void*) = nullptr;
  void (*(*get_function)(const char*))() = nullptr;
  find(library, "OSMesaCreateContextAttribs", create);
  find(library, "OSMesaMakeCurrent", make_current_);
  find(library, "OSMesaGetProcAddress", get_function);
  if (create == nullptr || make_current_ == nullptr || get_function == nullptr)
    return std::string(library_name) + " is not the one of Mesa; install the package libosmesa6";
  context_ = create(core_profile_4_5, nullptr);
  if (context_ == nullptr)
    return std::string(library_name) +
           " makes no context of OpenGL 4.5; GALLIUM_DRIVER must be unset or llvmpipe";
#define IMP_GL_FUNCTION(result, name, parameters) \
  gl_.name = reinterpret_cast<decltype(gl_.name)>(get_function("gl" #name));
  IMP_GL_FUNCTIONS
#undef IMP_GL_FUNCTION

  const Current current(*this);
  gl_.GenBuffers(static_cast<int>(buffers_.size()), buffers_.data());
  for (unsigned i = 0; i < buffers_.size(); ++i) gl_.BindBufferBase(gl::storage_buffer, i, buffers_[i]);
  return "";
}

std::expected<gl::Name, std::string> GlContext::compile(const std::string& text) {
  const Current current(*this);
  const gl::Name shader = gl_.CreateShader(gl::compute_shader);
  const char* source = text.c_str();
  gl_.ShaderSource(shader, 1, &source, nullptr);
  gl_.CompileShader(shader);
  int compiled = 0;
  gl_.GetShaderiv(shader, gl::compile_status, &compiled);
  auto program = compiled != 0 ? link(shader) : std::unexpected(log_of(shader, gl_.GetShaderInfoLog));
  gl_.DeleteShader(shader);
  return program;
}

std::expected<gl::Name, std::string> GlContext::link(gl::Name shader) {
  const gl::Name program = gl_.CreateProgram();
  gl_.AttachShader(program, shader);
  gl_.LinkProgram(program);
  int linked = 0;
  gl_.GetProgramiv(program, gl::link_status, &linked);
  if (linked != 0) return program;
  std::string why = log_of(program, gl_.GetProgramInfoLog);
  gl_.DeleteProgram(program);
  return std::unexpected(std::move(why));
}

void GlContext::remove(gl::Name program) {
  const Current current(*this);
  gl_.DeleteProgram(program);
}

void GlContext::dispatch(gl::Name program, std::uint32_t rays, std::span<const std::uint32_t> cells,
                         std::span<const std::uint32_t> in, std::span<std::uint32_t> out) {
  const Current current(*this);
  const auto fill = [&](unsigned buffer, std::size_t size, const void* data) {
    gl_.BindBufferBase(gl::storage_buffer, buffer, buffers_[buffer]);
    gl_.BufferData(gl::storage_buffer, static_cast<std::ptrdiff_t>(size), data, gl::stream_copy);
  };
  fill(0, cells.size_bytes(), cells.data());
  fill(1, in.size_bytes(), in.data());
  fill(2, out.size_bytes(), nullptr);  // the last one bound is the one that is read below
  gl_.UseProgram(program);
  gl_.Uniform1ui(gl_.GetUniformLocation(program, "size"), rays);
  gl_.DispatchCompute(std::max(1u, (rays + group_size - 1) / group_size), 1, 1);
  gl_.MemoryBarrier(gl::all_barriers);
  if (!out.empty())
    gl_.GetBufferSubData(gl::storage_buffer, 0, static_cast<std::ptrdiff_t>(out.size_bytes()), out.data());
  IMP_ASSERT(gl_.GetError() == gl::no_error, "calls that GL accepts");
}

}  // namespace imp
