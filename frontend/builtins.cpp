#include "frontend/builtins.h"

#include <algorithm>
#include <array>

namespace imp::syntax {
namespace {

// An op under its own name.
Builtin function(Op op) {
  return {info(op).name, Meaning::op, op, static_cast<std::uint32_t>(info(op).arity)};
}

}  // namespace

std::span<const Builtin> builtins() {
  static const std::array table{
      Builtin{"pi", Meaning::pi, Op::constant, 0},
      function(Op::sqrt),
      function(Op::cbrt),
      function(Op::exp),
      function(Op::log),
      function(Op::sin),
      function(Op::cos),
      function(Op::tan),
      function(Op::asin),
      function(Op::acos),
      function(Op::atan),
      function(Op::atan2),
      function(Op::sinh),
      function(Op::cosh),
      function(Op::tanh),
      function(Op::asinh),
      function(Op::acosh),
      function(Op::atanh),
      function(Op::floor),
      function(Op::ceil),
      function(Op::sign),
      function(Op::mod),
      function(Op::abs),
      Builtin{"min", Meaning::fold, Op::min, 2},
      Builtin{"max", Meaning::fold, Op::max, 2},
      Builtin{"pow", Meaning::power, Op::pow, 2},
      Builtin{"T", Meaning::chebyshev, Op::constant, 2},
      Builtin{"sum", Meaning::series, Op::add, 4},
      Builtin{"product", Meaning::series, Op::mul, 4},
      Builtin{"if", Meaning::choice, Op::select, 3},
  };
  return table;
}

const Builtin* find_builtin(std::string_view name) {
  const auto known = builtins();
  const auto found = std::ranges::find(known, name, &Builtin::name);
  return found == known.end() ? nullptr : &*found;
}

}  // namespace imp::syntax
