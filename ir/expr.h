// Math that reads like math: values under construction, which carry their graph with them.
// A truth value is not a number; mixing them does not compile.
#pragma once

#include "ir/graph.h"

namespace imp {

struct Expr {
  Graph* graph = nullptr;
  Id id;

  Type type() const { return (*graph)[id].type; }
  friend bool operator==(Expr a, Expr b) { return a.id == b.id; }
};

struct Truth {
  Graph* graph = nullptr;
  Id id;
};

inline Expr make(Op op, Expr a) { return {a.graph, a.graph->add(op, {a.id})}; }
inline Expr make(Op op, Expr a, Expr b) { return {a.graph, a.graph->add(op, {a.id, b.id})}; }
inline Expr make(Op op, Expr a, Expr b, Expr c) { return {a.graph, a.graph->add(op, {a.id, b.id, c.id})}; }
inline Truth compare(Op op, Expr a, Expr b) { return {a.graph, a.graph->add(op, {a.id, b.id})}; }

// The constant `value`, of the type of `like`.
inline Expr constant_like(Expr like, double value) {
  return {like.graph, like.graph->constant(like.type(), value)};
}
inline Expr zero(Expr like) { return constant_like(like, 0); }
inline Expr one(Expr like) { return constant_like(like, 1); }
inline Truth truth_of(Graph& graph, bool value) { return {&graph, graph.constant(value)}; }

#define IMP_BINARY(symbol, op)                                                               \
  inline Expr operator symbol(Expr a, Expr b) { return make(op, a, b); }                     \
  inline Expr operator symbol(Expr a, double b) { return make(op, a, constant_like(a, b)); } \
  inline Expr operator symbol(double a, Expr b) { return make(op, constant_like(b, a), b); }
IMP_BINARY(+, Op::add)
IMP_BINARY(-, Op::sub)
IMP_BINARY(*, Op::mul)
IMP_BINARY(/, Op::div)
#undef IMP_BINARY

inline Expr operator-(Expr a) { return make(Op::neg, a); }

#define IMP_COMPARE(symbol, expression)                                                   \
  inline Truth operator symbol(Expr a, Expr b) { return expression; }                     \
  inline Truth operator symbol(Expr a, double b) { return a symbol constant_like(a, b); } \
  inline Truth operator symbol(double a, Expr b) { return constant_like(b, a) symbol b; }
IMP_COMPARE(<, compare(Op::lt, a, b))
IMP_COMPARE(<=, compare(Op::le, a, b))
IMP_COMPARE(>, compare(Op::lt, b, a))
IMP_COMPARE(>=, compare(Op::le, b, a))
#undef IMP_COMPARE
inline Truth equal(Expr a, Expr b) { return compare(Op::eq, a, b); }

inline Truth operator&&(Truth a, Truth b) { return {a.graph, a.graph->add(Op::and_, {a.id, b.id})}; }
inline Truth operator||(Truth a, Truth b) { return {a.graph, a.graph->add(Op::or_, {a.id, b.id})}; }
inline Truth operator!(Truth a) { return {a.graph, a.graph->add(Op::not_, {a.id})}; }

inline Expr select(Truth c, Expr a, Expr b) {
  return {a.graph, a.graph->add(Op::select, {c.id, a.id, b.id})};
}
inline Truth select(Truth c, Truth a, Truth b) { return (c && a) || (!c && b); }

inline Expr abs(Expr a) { return make(Op::abs, a); }
inline Expr sqrt(Expr a) { return make(Op::sqrt, a); }
inline Expr floor(Expr a) { return make(Op::floor, a); }
inline Expr ceil(Expr a) { return make(Op::ceil, a); }
inline Expr min(Expr a, Expr b) { return make(Op::min, a, b); }
inline Expr max(Expr a, Expr b) { return make(Op::max, a, b); }
inline Expr fma(Expr a, Expr b, Expr c) { return make(Op::fma, a, b, c); }

inline Expr add_up(Expr a, Expr b) { return make(Op::add_up, a, b); }
inline Expr mul_up(Expr a, Expr b) { return make(Op::mul_up, a, b); }
inline Expr div_up(Expr a, Expr b) { return make(Op::div_up, a, b); }
inline Expr sqrt_up(Expr a) { return make(Op::sqrt_up, a); }
inline Expr fma_up(Expr a, Expr b, Expr c) { return make(Op::fma_up, a, b, c); }

inline Expr widen(Expr a) { return make(Op::widen, a); }
inline Expr narrow(Expr a) { return make(Op::narrow, a); }
inline Expr narrow_up(Expr a) { return make(Op::narrow_up, a); }

// `a` as a number of `type`, rounded to nearest if that is the narrower one.
inline Expr to(Type type, Expr a) {
  if (a.type() == type) return a;
  return type == f32 ? narrow(a) : widen(a);
}

inline Truth any(Truth a) { return {a.graph, a.graph->add(Op::any, {a.id})}; }
inline Truth all(Truth a) { return {a.graph, a.graph->add(Op::all, {a.id})}; }

}  // namespace imp
