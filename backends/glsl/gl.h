// The part of OpenGL 4.5 that compute shaders take, by pointers: no header of GL is needed to build.
#pragma once

#include <cstddef>
#include <cstdint>

namespace imp::gl {

using Enum = unsigned;
using Name = unsigned;  // of an object

inline constexpr Enum no_error = 0, compile_status = 0x8B81, link_status = 0x8B82, stream_copy = 0x88E2,
                      compute_shader = 0x91B9, storage_buffer = 0x90D2;
inline constexpr unsigned all_barriers = ~0u;

// IMP_GL_FUNCTION(result, name, parameters): those that are used.
#define IMP_GL_FUNCTIONS                                                                 \
  IMP_GL_FUNCTION(Enum, GetError, ())                                                    \
  IMP_GL_FUNCTION(Name, CreateShader, (Enum))                                            \
  IMP_GL_FUNCTION(void, ShaderSource, (Name, int, const char* const*, const int*))       \
  IMP_GL_FUNCTION(void, CompileShader, (Name))                                           \
  IMP_GL_FUNCTION(void, GetShaderiv, (Name, Enum, int*))                                 \
  IMP_GL_FUNCTION(void, GetShaderInfoLog, (Name, int, int*, char*))                      \
  IMP_GL_FUNCTION(void, DeleteShader, (Name))                                            \
  IMP_GL_FUNCTION(Name, CreateProgram, ())                                               \
  IMP_GL_FUNCTION(void, AttachShader, (Name, Name))                                      \
  IMP_GL_FUNCTION(void, LinkProgram, (Name))                                             \
  IMP_GL_FUNCTION(void, GetProgramiv, (Name, Enum, int*))                                \
  IMP_GL_FUNCTION(void, GetProgramInfoLog, (Name, int, int*, char*))                     \
  IMP_GL_FUNCTION(void, DeleteProgram, (Name))                                           \
  IMP_GL_FUNCTION(void, UseProgram, (Name))                                              \
  IMP_GL_FUNCTION(int, GetUniformLocation, (Name, const char*))                          \
  IMP_GL_FUNCTION(void, Uniform1ui, (int, unsigned))                                     \
  IMP_GL_FUNCTION(void, GenBuffers, (int, Name*))                                        \
  IMP_GL_FUNCTION(void, BindBufferBase, (Enum, unsigned, Name))                          \
  IMP_GL_FUNCTION(void, BufferData, (Enum, std::ptrdiff_t, const void*, Enum))           \
  IMP_GL_FUNCTION(void, GetBufferSubData, (Enum, std::ptrdiff_t, std::ptrdiff_t, void*)) \
  IMP_GL_FUNCTION(void, DispatchCompute, (unsigned, unsigned, unsigned))                 \
  IMP_GL_FUNCTION(void, MemoryBarrier, (unsigned))

struct Functions {
#define IMP_GL_FUNCTION(result, name, parameters) result(*name) parameters = nullptr;
  IMP_GL_FUNCTIONS
#undef IMP_GL_FUNCTION
};

}  // namespace imp::gl
