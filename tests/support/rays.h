// The data of one Kernel call, as numbers: inputs set by index, outputs read by index.
#pragma once

#include <cstring>
#include <vector>

#include "backends/kernel.h"

namespace imp::test {

class Rays {
 public:
  Rays(const Program& program, std::size_t size) : program_(program), size_(size) {
    for (const Input& input : program.inputs)
      inputs_.emplace_back(bytes(input.type) *
                           (input.rate == Rate::ray ? size : std::max(1u, input.type.length)));
    for (const Output& output : program.outputs) outputs_.emplace_back(bytes(type(output)) * size);
  }

  // `i` counts rays or, of a table, elements; it is 0 for what a frame or cell has one of.
  void set(std::size_t input, std::size_t i, double value) {
    put(inputs_[input], i, program_.inputs[input].type, value);
  }
  // The same value everywhere; a table gets value, value + 1, …
  void fill(std::size_t input, double value) {
    const Type type = program_.inputs[input].type;
    for (std::size_t i = 0; i < inputs_[input].size() / bytes(type); ++i)
      set(input, i, type.is_table() ? value + static_cast<double>(i) : value);
  }

  double get(std::size_t output, std::size_t ray) const {
    const Type t = type(program_.outputs[output]);
    const unsigned char* from = outputs_[output].data() + ray * bytes(t);
    if (t.is_truth()) return *from;
    if (t == f32) return load<float>(from);
    return load<double>(from);
  }
  // The bytes of an output, to compare bit for bit.
  const std::vector<unsigned char>& raw(std::size_t output) const { return outputs_[output]; }

  Rays& run(const Kernel& kernel) {
    std::vector<const void*> in;
    std::vector<void*> out;
    for (const auto& data : inputs_) in.push_back(data.data());
    for (auto& data : outputs_) out.push_back(data.data());
    kernel.run({size_, in, out});
    return *this;
  }

 private:
  static std::size_t bytes(Type type) {
    return type.scalar == Scalar::truth ? 1 : type.scalar == Scalar::f32 ? 4 : 8;
  }
  Type type(const Output& output) const { return program_.graph[output.id].type; }

  template <class T>
  static double load(const unsigned char* from) {
    T value;
    std::memcpy(&value, from, sizeof value);
    return value;
  }
  static void put(std::vector<unsigned char>& data, std::size_t i, Type type, double value) {
    unsigned char* to = data.data() + i * bytes(type);
    const auto narrow = static_cast<float>(value);
    if (type.scalar == Scalar::truth) *to = value != 0;
    if (type.scalar == Scalar::f32) std::memcpy(to, &narrow, sizeof narrow);
    if (type.scalar == Scalar::f64) std::memcpy(to, &value, sizeof value);
  }

  const Program& program_;
  std::size_t size_;
  std::vector<std::vector<unsigned char>> inputs_, outputs_;
};

}  // namespace imp::test
