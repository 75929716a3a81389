// Runs a Program for one ray by the reference backend, numbers as doubles.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <vector>

#include "backends/interpreter/interpreter.h"
#include "ir/expr.h"

namespace imp::test {

// Numbers of any type, as a backend wants them.
class Cells {
 public:
  explicit Cells(Type type) : type_(type), bytes_(8 * (type.length + 1)) {}

  void set(double first) {  // a table counts on from there
    for (std::size_t i = 0; i <= type_.length; ++i) {
      const double value = i == 0 ? first : first + static_cast<double>(i);  // -0 stays
      if (type_.scalar == Scalar::truth) bytes_[i] = value != 0;
      if (type_.scalar == Scalar::f32) put(i, static_cast<float>(value));
      if (type_.scalar == Scalar::f64) put(i, value);
    }
  }
  double get() const {
    if (type_.scalar == Scalar::truth) return bytes_[0] != 0 ? 1 : 0;
    return type_.scalar == Scalar::f32 ? take<float>() : take<double>();
  }
  void* data() { return bytes_.data(); }

 private:
  template <class T>
  void put(std::size_t i, T value) {
    std::memcpy(bytes_.data() + i * sizeof value, &value, sizeof value);
  }
  template <class T>
  T take() const {
    T value;
    std::memcpy(&value, bytes_.data(), sizeof value);
    return value;
  }

  Type type_;
  std::vector<unsigned char> bytes_;
};

inline std::vector<double> evaluate(const Kernel& kernel, std::span<const double> inputs) {
  const Program& program = kernel.program();
  std::vector<Cells> in, out;
  for (const Input& input : program.inputs) in.emplace_back(input.type).set(inputs[in.size() - 1]);
  for (const Output& output : program.outputs) out.emplace_back(program.graph[output.id].type);
  std::vector<const void*> from;
  std::vector<void*> to;
  for (Cells& cells : in) from.push_back(cells.data());
  for (Cells& cells : out) to.push_back(cells.data());
  kernel.run({1, from, to});

  std::vector<double> values;
  for (const Cells& cells : out) values.push_back(cells.get());
  return values;
}

inline std::vector<double> evaluate(const Program& program, std::span<const double> inputs) {
  return evaluate(*interpret(program), inputs);
}
inline std::vector<double> evaluate(const Program& program, std::initializer_list<double> inputs) {
  return evaluate(program, std::span(inputs.begin(), inputs.size()));
}

// `program` made to run in upward rounding, by one more output.
inline Program upward(Program program) {
  const Id one = program.graph.constant(f64, 1);
  const Expr x{&program.graph, program.graph.leaf(Op::input, f64, program.inputs.size())};
  program.inputs.push_back({"upward", f64, Rate::frame, x.id});
  program.outputs.push_back({"upward", add_up(x, {&program.graph, one}).id});
  return program;
}

// NaN is NaN, and zeros have signs.
inline bool same_bits(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) ||
         std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

inline constexpr double special_values[] = {
    0.0,       -0.0,    1.0,      -1.0,  0.5,      -2.0,      3.0,    1.0 / 3,
    -0.1,      1e10,    -1e-10,   1e200, -1e300,   1e-300,    5e-324, -5e-324,
    0x1p-1022, 1.7e308, -1.7e308, 2.5,   INFINITY, -INFINITY, NAN,
};

}  // namespace imp::test
