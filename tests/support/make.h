// Short ways to build Programs in tests.
#pragma once

#include <string>

#include "ir/expr.h"
#include "ir/program.h"

namespace imp::test {

inline Expr input(Program& program, std::string name, Type type = f32, Rate rate = Rate::ray) {
  const Id id = add_input(program, std::move(name), type, rate);
  return {&program.graph, id};
}
inline Truth truth_input(Program& program, std::string name, Rate rate = Rate::ray) {
  const Id id = add_input(program, std::move(name), truth, rate);
  return {&program.graph, id};
}
inline Expr number(Program& program, double value, Type type = f32) {
  return {&program.graph, program.graph.constant(type, value)};
}
inline Expr power(Expr x, double n) { return make(Op::powi, x, constant_like(x, n)); }
inline void output(Program& program, std::string name, Expr value) {
  program.outputs.push_back({std::move(name), value.id});
}
inline void output(Program& program, std::string name, Truth value) {
  program.outputs.push_back({std::move(name), value.id});
}

}  // namespace imp::test
