// What the tests of the LLVM backend share: targets, columns of numbers, and equality of floats.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "backends/interpreter/interpreter.h"
#include "backends/llvm/compile.h"
#include "ir/text.h"
#include "ir/verify.h"

namespace imp {

inline std::vector<CpuTarget> targets_here() {
  std::vector<CpuTarget> here;
  for (CpuTarget& target : cpu_targets())
    if (target.runs_here) here.push_back(std::move(target));
  return here;
}

inline Program parsed(const std::string& text) {
  Diagnostics diagnostics;
  auto program = parse_program(text, "test", diagnostics);
  EXPECT_TRUE(program.has_value()) << to_text(diagnostics);
  return program.value();
}

inline std::unique_ptr<Kernel> compiled(const Program& program, const CpuTarget& target) {
  EXPECT_EQ(verify(program), "");
  auto kernel = compile(program, target);
  EXPECT_TRUE(kernel.has_value()) << kernel.error().message;
  return std::move(kernel).value();
}

// One value a ray, or one in all, or the values of a table; truths are 0 and 1. A double holds them all.
using Column = std::vector<double>;

inline std::vector<unsigned char> packed(Type type, const Column& values) {
  std::vector<unsigned char> bytes;
  const auto append = [&](auto value) {
    const auto* first = reinterpret_cast<const unsigned char*>(&value);
    bytes.insert(bytes.end(), first, first + sizeof value);
  };
  for (const double value : values) {
    if (type.scalar == Scalar::f64)
      append(value);
    else if (type.scalar == Scalar::f32)
      append(static_cast<float>(value));
    else
      append(static_cast<unsigned char>(value != 0));
  }
  return bytes;
}

inline Column unpacked(Type type, const std::vector<unsigned char>& bytes) {
  Column values;
  const auto read_as = [&]<class T>(T value) {
    for (std::size_t at = 0; at + sizeof value <= bytes.size(); at += sizeof value) {
      std::memcpy(&value, bytes.data() + at, sizeof value);
      values.push_back(static_cast<double>(value));
    }
  };
  if (type.scalar == Scalar::f64)
    read_as(double{});
  else if (type.scalar == Scalar::f32)
    read_as(float{});
  else
    read_as(static_cast<unsigned char>(0));
  return values;
}

// The outputs for `size` rays. Fails where the kernel writes behind them.
inline std::vector<Column> run(const Kernel& kernel, const std::vector<Column>& inputs, std::size_t size) {
  const Program& program = kernel.program();
  constexpr std::size_t guard = 64;
  std::vector<std::vector<unsigned char>> data, results;
  std::vector<const void*> in;
  std::vector<void*> out;
  for (std::size_t i = 0; i < inputs.size(); ++i) data.push_back(packed(program.inputs[i].type, inputs[i]));
  for (const auto& bytes : data) in.push_back(bytes.data());
  for (const Output& output : program.outputs)
    results.emplace_back(packed(program.graph[output.id].type, Column(size)).size() + guard, 0xab);
  for (auto& bytes : results) out.push_back(bytes.data());
  kernel.run({size, in, out});

  std::vector<Column> columns;
  for (std::size_t i = 0; i < results.size(); ++i) {
    for (std::size_t k = results[i].size() - guard; k < results[i].size(); ++k)
      EXPECT_EQ(results[i][k], 0xab) << "written behind the end";
    results[i].resize(results[i].size() - guard);
    columns.push_back(unpacked(program.graph[program.outputs[i].id].type, results[i]));
  }
  return columns;
}

// Bit for bit, except that a NaN is a NaN.
inline bool same(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) ||
         std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

inline void expect_same(const std::vector<Column>& got, const std::vector<Column>& expected,
                        const std::string& where) {
  ASSERT_EQ(got.size(), expected.size()) << where;
  for (std::size_t i = 0; i < got.size(); ++i) {
    ASSERT_EQ(got[i].size(), expected[i].size()) << where;
    for (std::size_t ray = 0; ray < got[i].size(); ++ray)
      ASSERT_TRUE(same(got[i][ray], expected[i][ray])) << where << ": output " << i << ", ray " << ray << ": "
                                                       << got[i][ray] << ", not " << expected[i][ray];
  }
}

// The same as the interpreter on every target, for 0 to a few packets of rays.
inline void expect_agreement(const Program& program, const std::vector<Column>& inputs) {
  const auto reference = interpret(program);
  for (const CpuTarget& target : targets_here()) {
    const auto kernel = compiled(program, target);
    for (std::size_t size = 0; size <= 2 * target.lanes(program) + 1; ++size)
      expect_same(run(*kernel, inputs, size), run(*reference, inputs, size),
                  target.name + ", " + std::to_string(size) + " rays");
  }
}

// Numbers for 65 rays, two packets of the widest target and one ray.
inline Column ramp(double from, double step) {
  Column values;
  for (int i = 0; i <= 64; ++i) values.push_back(static_cast<float>(from + step * i));
  return values;
}

}  // namespace imp
