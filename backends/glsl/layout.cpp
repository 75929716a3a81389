#include "backends/glsl/layout.h"

#include <algorithm>
#include <utility>

namespace imp {

std::uint32_t words(Type type) { return std::max(1u, type.length) * (type.scalar == Scalar::f64 ? 2 : 1); }

Layout::Layout(const Program& program) {
  for (const Input& input : program.inputs) {
    std::uint32_t& end = input.rate == Rate::ray ? ray_words : cell_words;
    inputs.push_back(std::exchange(end, end + words(input.type)));
  }
  for (const Output& output : program.outputs)
    outputs.push_back(std::exchange(result_words, result_words + words(program.graph[output.id].type)));
}

}  // namespace imp
