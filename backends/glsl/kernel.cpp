#include "backends/glsl/kernel.h"

#include <algorithm>
#include <cstring>

#include "backends/glsl/context.h"
#include "backends/glsl/emit.h"
#include "backends/glsl/layout.h"
#include "ir/assert.h"

namespace imp {
namespace {

// Of one dispatch: GL promises 65535 work groups and buffers of 2^27 bytes.
constexpr std::size_t most_rays = std::size_t{1} << 21, most_words = std::size_t{1} << 24;

std::size_t bytes(Type type) { return type.scalar == Scalar::truth ? 1 : type.scalar == Scalar::f32 ? 4 : 8; }

// `count` values of a batch into words of a buffer.
void pack(Type type, const void* data, std::size_t first, std::size_t count, std::uint32_t* to) {
  const auto* from = static_cast<const unsigned char*>(data) + first * bytes(type);
  if (type.scalar == Scalar::truth)
    std::transform(from, from + count, to, [](unsigned char byte) { return byte != 0 ? 1u : 0u; });
  else
    std::memcpy(to, from, count * bytes(type));
}

void unpack(Type type, const std::uint32_t* from, std::size_t first, std::size_t count, void* data) {
  auto* to = static_cast<unsigned char*>(data) + first * bytes(type);
  if (type.scalar == Scalar::truth)
    std::transform(from, from + count, to, [](std::uint32_t word) { return word != 0 ? 1 : 0; });
  else
    std::memcpy(to, from, count * bytes(type));
}

class GlslKernel : public Kernel {
 public:
  GlslKernel(Program run, GlContext& gl, gl::Name shader)
      : Kernel(std::move(run)), gl_(gl), shader_(shader), layout_(program()) {}
  ~GlslKernel() override { gl_.remove(shader_); }
  GlslKernel(const GlslKernel&) = delete;
  GlslKernel& operator=(const GlslKernel&) = delete;

  void run(const Batch& batch) const override {
    IMP_ASSERT(batch.inputs.size() == program().inputs.size(), "one column an input");
    IMP_ASSERT(batch.outputs.size() == program().outputs.size(), "one column an output");
    std::vector<std::uint32_t> cells(layout_.cell_words);
    for (std::size_t i = 0; i < batch.inputs.size(); ++i)
      if (const Input& input = program().inputs[i]; input.rate != Rate::ray && batch.inputs[i] != nullptr)
        pack(input.type, batch.inputs[i], 0, std::max(1u, input.type.length), &cells[layout_.inputs[i]]);

    const std::size_t words = std::max({1u, layout_.ray_words, layout_.result_words});
    const std::size_t most = std::min(most_rays, most_words / words);
    std::vector<std::uint32_t> in, out;
    for (std::size_t first = 0; first < batch.size; first += most) {
      const std::size_t size = std::min(most, batch.size - first);
      in.resize(size * layout_.ray_words);
      out.resize(size * layout_.result_words);
      for (std::size_t i = 0; i < batch.inputs.size(); ++i)
        if (const Input& input = program().inputs[i]; input.rate == Rate::ray && batch.inputs[i] != nullptr)
          pack(input.type, batch.inputs[i], first, size, in.data() + layout_.inputs[i] * size);
      gl_.dispatch(shader_, static_cast<std::uint32_t>(size), cells, in, out);
      for (std::size_t i = 0; i < batch.outputs.size(); ++i)
        if (batch.outputs[i] != nullptr)
          unpack(program().graph[program().outputs[i].id].type, out.data() + layout_.outputs[i] * size, first,
                 size, batch.outputs[i]);
    }
  }

 private:
  GlContext& gl_;
  gl::Name shader_;
  Layout layout_;
};

}  // namespace

std::expected<std::unique_ptr<Kernel>, Refusal> compile_glsl(Program program) {
  const auto text = emit_glsl(program);
  if (!text) return std::unexpected(text.error());
  const auto gl = GlContext::get();
  if (!gl) return std::unexpected(Refusal{gl.error()});
  const auto shader = (*gl)->compile(*text);
  if (!shader) return std::unexpected(Refusal{"the compiler of GLSL refuses: " + shader.error()});
  (*gl)->dispatch(*shader, 0, {}, {}, {});  // where Mesa makes machine code
  return std::make_unique<GlslKernel>(std::move(program), **gl, *shader);
}

}  // namespace imp
