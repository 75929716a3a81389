#include "passes/elementary/bounds.h"

#include <cmath>
#include <limits>

#include "ir/assert.h"

namespace imp::elementary {
namespace {

enum class Values : std::int8_t {
  any,
  never_negative,
  fading,  // of any sign, and fading out to 0
};

struct Row {
  Op op;
  double f32_ulps, f64_ulps;
  Values values;
};

constexpr Row rows[] = {
    {Op::exp, 2, 4, Values::never_negative},
    {Op::log, 2, 4, Values::any},
    {Op::pow, 2, 4, Values::never_negative},
    {Op::cbrt, 2, 4, Values::any},
    {Op::sin, 2, 4, Values::any},
    {Op::cos, 2, 4, Values::any},
    {Op::tan, 2, 4, Values::any},
    {Op::asin, 2, 4, Values::any},
    {Op::acos, 2, 4, Values::never_negative},
    {Op::atan, 2, 4, Values::any},
    {Op::atan2, 2, 4, Values::fading},
    {Op::sinh, 2, 4, Values::any},
    {Op::cosh, 2, 4, Values::never_negative},
    {Op::tanh, 2, 4, Values::any},
    {Op::asinh, 2, 4, Values::any},
    {Op::acosh, 2, 4, Values::never_negative},
    {Op::atanh, 2, 4, Values::any},
};

const Row* row_of(Op op) {
  for (const Row& row : rows)
    if (row.op == op) return &row;
  return nullptr;
}

double epsilon(Type type) { return type == f32 ? 0x1p-23 : 0x1p-52; }
double smallest_normal(Type type) { return type == f32 ? 0x1p-126 : 0x1p-1022; }
double largest(Type type) {
  return type == f32 ? std::numeric_limits<float>::max() : std::numeric_limits<double>::max();
}

// An error of n ulps is at most n eps of the exact value, and so at most n eps / (1 - n eps) of the
// computed one; one eps more pays for that.
double share(const Row& row, Type type) {
  return (1 + (type == f32 ? row.f32_ulps : row.f64_ulps)) * epsilon(type);
}

// v (1 + share) where v > 0, v (1 - share) where v < 0.
Expr grown(const Row& row, Expr v) {
  const double c = share(row, v.type());
  return mul_up(v, select(v < 0, constant_like(v, 1 - c), constant_like(v, 1 + c)));
}

}  // namespace

std::optional<double> ulps(Op op, Type type) {
  const Row* row = row_of(op);
  if (!row) return std::nullopt;
  return type == f32 ? row->f32_ulps : row->f64_ulps;
}

double largest_angle(Type type) { return type == f32 ? 12'800 : 0x1p30; }

// Where the exact value is no denormal, the computed one is not 0; but exp, pow and atan2 fade out to 0, and a
// driver may round what is left of them to 0: there the bound is the smallest normal number. Other denormals
// are off by an ulp at most, which the rounding of their product pays. What overflows passes the exact value
// on one side only. NaN stays.
Expr above(Op op, Expr value) {
  const Row* row = row_of(op);
  IMP_ASSERT(row, "an elementary function");
  const Type type = value.type();
  const Expr lowest = constant_like(value, -largest(type)),
             tiny = constant_like(value, smallest_normal(type));
  if (row->values == Values::never_negative)
    return max(tiny, mul_up(value, constant_like(value, 1 + share(*row, type))));
  const Expr up = max(lowest, grown(*row, value));
  return row->values == Values::fading ? select(abs(value) < tiny, tiny, up) : up;
}

Expr minus_below(Op op, Expr value) {
  const Row* row = row_of(op);
  IMP_ASSERT(row, "an elementary function");
  if (row->values != Values::never_negative) return above(op, -value);
  const Type type = value.type();
  const Expr lowest = constant_like(value, -largest(type));
  const Expr down = mul_up(-value, constant_like(value, 1 - share(*row, type)));
  return select(value < constant_like(value, smallest_normal(type)), zero(value), max(lowest, down));
}

}  // namespace imp::elementary
