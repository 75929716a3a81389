// Where the values of a batch lie in the three buffers of a shader. Shader and host agree on it here.
//
//   cells    the inputs of rate frame and cell, one after another
//   rays     the inputs of rate ray, a column each: slot * size words before it, for `size` rays
//   results  the outputs, in the same way
//
// All buffers are of 32-bit words, so that their number is the same for every Program: a float or a truth
// is one word, a double two, the low one first.
#pragma once

#include <cstdint>
#include <vector>

#include "ir/program.h"

namespace imp {

struct Layout {
  explicit Layout(const Program& program);

  // By input: the first word in cells, or the slot in rays. By output: the slot in results.
  std::vector<std::uint32_t> inputs, outputs;
  std::uint32_t cell_words = 0, ray_words = 0, result_words = 0;  // of the last two: for one ray
};

// The words of one value, or of all values of a table.
std::uint32_t words(Type type);

}  // namespace imp
