// Canonicalisation: the rules. What is the same bits in either rounding mode, NaN and signed zeros
// included, is written in one way. A sign is moved only through what is exact, or cancelled.
#include "passes/canonicalize.h"

#include <cmath>

#include "passes/rewrite.h"
#include "passes/rules.h"

namespace imp {
namespace {

bool is_negative(double k) { return std::signbit(k) && !std::isnan(k); }

bool is_power_of_two(double k) {
  int exponent;
  return k > 0 && std::frexp(k, &exponent) == 0.5;
}

// 2, 4, 8, …: there meaning::powi only squares.
bool only_squares(double k) { return k >= 2 && is_power_of_two(k); }

// Then 1/k is exact, and neither of the two is denormal in any type.
bool has_exact_inverse(double k) {
  return is_power_of_two(std::abs(k)) && std::abs(k) >= 0x1p-126 && std::abs(k) <= 0x1p126;
}

constexpr AlgebraRule rules[] = {
    {"powi a 1", "a"},
    {"powi neg a k", "powi a k", only_squares},
    {"powi abs a k", "powi a k", only_squares},
    {"mul abs a abs a", "mul a a"},

    {"mul a -1", "neg a"},
    {"div a -1", "neg a"},
    {"div a k", "mul a div 1 k", has_exact_inverse},
    {"mul neg a neg b", "mul a b"},
    {"div neg a neg b", "div a b"},
    {"mul_up neg a neg b", "mul_up a b"},
    {"div_up neg a neg b", "div_up a b"},
    {"mul neg a k", "mul a neg k"},
    {"div neg a k", "div a neg k"},
    {"div k neg a", "div neg k a"},

    {"add a a", "mul a 2"},
    {"add a neg b", "sub a b"},
    {"sub a neg b", "add a b"},
    {"sub -0 a", "neg a"},
    {"sub neg a k", "sub neg k a"},
    {"add a k", "sub a neg k", is_negative},
    {"sub a k", "add a neg k", is_negative},

    {"min neg a neg b", "neg max a b"},
    {"max neg a neg b", "neg min a b"},
    {"floor floor a", "floor a"},
    {"floor ceil a", "ceil a"},
    {"ceil ceil a", "ceil a"},
    {"ceil floor a", "floor a"},
    {"sign sign a", "sign a"},
    {"narrow widen a", "a"},
    {"narrow_up widen a", "a"},

    {"lt neg a neg b", "lt b a"},
    {"le neg a neg b", "le b a"},
    {"eq neg a neg b", "eq a b"},
    {"lt neg a k", "lt neg k a"},
    {"le neg a k", "le neg k a"},
    {"eq neg a k", "eq a neg k"},
    {"lt k neg a", "lt a neg k"},
    {"le k neg a", "le a neg k"},

    {"and a not a", "false"},
    {"or a not a", "true"},
    {"and a or a b", "a"},
    {"or a and a b", "a"},

    {"select lt a b a b", "min a b"},
    {"select lt b a a b", "max a b"},
    {"select c select c a b d", "select c a d"},
    {"select c a select c b d", "select c a d"},
};

bool is_structure(Op op) { return info(op).kind == OpKind::structure; }

}  // namespace

std::span<const AlgebraRule> canonical_rules() { return rules; }

Program canonicalize(const Program& program) {
  static const Algebra algebra(rules);
  return rewrite(program, [](Graph& graph, Id, const Node& node) {
    return is_structure(node.op) ? copy(graph, node) : algebra.add(graph, node.op, node.args);
  });
}

}  // namespace imp
