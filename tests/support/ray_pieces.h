// A polynomial along a ray: kernels that enclose its coefficients over pieces, and the exact ones to compare with.
#pragma once

#include <functional>

#include "passes/along_ray.h"
#include "passes/extend/interval_rules.h"
#include "tests/support/evaluate.h"
#include "tests/support/make.h"
#include "tests/support/random.h"
#include "tests/support/rational.h"

namespace imp::test {

// The variable of what is along a ray: the first input, s.
inline constexpr std::size_t first_input[] = {0};

// A ray o + s d, a piece [s0, s1] of it, and a parameter w.
struct RayPiece {
  double s0, s1;
  std::array<double, 3> o, d;
  double w;

  std::vector<double> numbers() const { return {s0, s1, o[0], o[1], o[2], d[0], d[1], d[2], w}; }
};

// Numbers of the type; one piece in four is the whole ray, one in eight a point.
inline RayPiece random_piece(Random& random, Type type, double size = 2) {
  const auto number = [&](double lo, double hi) {
    const double x = random.between(lo, hi);
    return type == f32 ? static_cast<double>(static_cast<float>(x)) : x;
  };
  RayPiece ray{0, 1, {}, {}, number(-1, 1)};
  for (double& x : ray.o) x = number(-size, size);
  for (double& x : ray.d) x = random.one_in(6) ? 0 : number(-2 * size, 2 * size);
  if (random.one_in(4)) return ray;
  ray.s0 = number(0, 1);
  ray.s1 = random.one_in(8) ? ray.s0 : number(ray.s0, ray.s0 + std::exp2(-random.between(0, 20)));
  if (ray.s1 > 1) ray.s1 = 1;
  return ray;
}

// f of x, y, z and w, as a polynomial in u over the piece s = s0 + (s1 - s0) u.
inline RationalPolynomial exact_along(const Program& f, const RayPiece& ray) {
  const RationalPolynomial s{Rational(ray.s0), Rational(ray.s1) - Rational(ray.s0)};
  std::vector<RationalPolynomial> inputs;
  const RationalRules rules;
  for (std::size_t i = 0; i < 3; ++i)
    inputs.push_back(rules.add(constant(ray.o[i]), rules.mul(constant(ray.d[i]), s)));
  inputs.push_back(constant(ray.w));
  return run_exactly(f, inputs);
}

// What is built of along_ray(f) over the piece: its inputs s, o, d, w in the type of a kernel.
using BuildIntervals =
    std::function<std::vector<Interval>(const Program& along, std::span<const Interval> inputs)>;

struct Ends {
  double lo, hi;
};

// The intervals that `build` makes, as a kernel for RayPieces.
class PieceKernel {
 public:
  PieceKernel(const Program& f, Type type, const BuildIntervals& build) {
    Program program{.name = "pieces"};
    const Expr s0 = input(program, "s0", type), s1 = input(program, "s1", type);
    std::vector<Interval> inputs{interval(-s0, s1)};
    for (const char* name : {"ox", "oy", "oz", "dx", "dy", "dz"})
      inputs.push_back(point(input(program, name, type)));
    inputs.push_back(point(input(program, "w", type, Rate::frame)));
    for (const Interval& x : build(along_ray(f), inputs)) {
      output(program, "nlo", x.nlo);
      output(program, "hi", x.hi);
    }
    kernel_ = interpret(compact(program));
  }

  std::vector<Ends> operator()(const RayPiece& ray) const {
    const auto values = evaluate(*kernel_, ray.numbers());
    std::vector<Ends> result;
    for (std::size_t i = 0; i < values.size(); i += 2) result.push_back({-values[i], values[i + 1]});
    return result;
  }
  const Program& program() const { return kernel_->program(); }

 private:
  std::unique_ptr<Kernel> kernel_;
};

}  // namespace imp::test
