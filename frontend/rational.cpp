#include "frontend/rational.h"

#include <algorithm>
#include <cmath>

#include "ir/replay.h"

namespace imp::syntax {
namespace {

using Value = Rationals::Value;
using Number = std::optional<mpq_class>;

std::size_t bits(const mpz_class& a) { return mpz_sizeinbase(a.get_mpz_t(), 2); }
std::size_t bits(const mpq_class& a) { return std::max(bits(a.get_num()), bits(a.get_den())); }

Value number(mpq_class a) {
  return bits(a) <= Rationals::most_bits ? Value{.number = std::move(a)} : Value{};
}
Value truth(bool a) { return {.truth = a}; }

mpq_class rounded_down(const mpq_class& a) {
  mpz_class whole;
  mpz_fdiv_q(whole.get_mpz_t(), a.get_num_mpz_t(), a.get_den_mpz_t());
  return whole;
}

// a^n, for a that has one of at most `most_bits`.
Number power(const mpq_class& a, unsigned long n) {
  if (n > 1 && bits(a) > 1 && (bits(a) - 1) * n > Rationals::most_bits) return std::nullopt;
  mpz_class above, below;
  mpz_pow_ui(above.get_mpz_t(), a.get_num_mpz_t(), n);
  mpz_pow_ui(below.get_mpz_t(), a.get_den_mpz_t(), n);
  return mpq_class(above, below);
}

// The root of degree n, of a number below 0 for an odd n only, where it is a fraction.
Number root(const mpq_class& a, unsigned long n) {
  if (a < 0 && n % 2 == 0) return std::nullopt;
  mpz_class above, below;
  const bool exact = mpz_root(above.get_mpz_t(), a.get_num_mpz_t(), n) != 0 &&
                     mpz_root(below.get_mpz_t(), a.get_den_mpz_t(), n) != 0;
  return exact ? Number(mpq_class(above, below)) : std::nullopt;
}

// One rule an op that makes fractions of fractions; an operand that is not known makes a result that is not.
struct RationalRules {
  using Value = Rationals::Value;

  Value add(const Value& a, const Value& b) { return both(a, b) ? number(*a.number + *b.number) : Value{}; }
  Value sub(const Value& a, const Value& b) { return both(a, b) ? number(*a.number - *b.number) : Value{}; }
  Value mul(const Value& a, const Value& b) { return both(a, b) ? number(*a.number * *b.number) : Value{}; }
  Value div(const Value& a, const Value& b) {
    return both(a, b) && *b.number != 0 ? number(*a.number / *b.number) : Value{};
  }
  Value neg(const Value& a) { return a.number ? number(-*a.number) : Value{}; }
  Value abs(const Value& a) { return a.number ? number(::abs(*a.number)) : Value{}; }
  Value min(const Value& a, const Value& b) { return both(a, b) ? (*a.number < *b.number ? a : b) : Value{}; }
  Value max(const Value& a, const Value& b) { return both(a, b) ? (*a.number > *b.number ? a : b) : Value{}; }
  Value floor(const Value& a) { return a.number ? number(rounded_down(*a.number)) : Value{}; }
  Value ceil(const Value& a) { return neg(floor(neg(a))); }
  Value sign(const Value& a) { return a.number ? number(sgn(*a.number)) : Value{}; }
  Value mod(const Value& a, const Value& b) { return sub(a, mul(b, floor(div(a, b)))); }
  Value sqrt(const Value& a) { return a.number ? known(root(*a.number, 2)) : Value{}; }
  Value cbrt(const Value& a) { return a.number ? known(root(*a.number, 3)) : Value{}; }

  Value powi(const Value& a, const Value& n) {
    if (!both(a, n)) return {};
    const double exponent = n.number->get_d();  // an integer up to 2^20
    const Value result = known(power(*a.number, static_cast<unsigned long>(std::abs(exponent))));
    return exponent < 0 ? div(number(1), result) : result;
  }

  // The exponent is no integer, or the op were powi.
  Value pow(const Value& a, const Value& b) {
    if (!both(a, b) || *a.number < 0) return {};
    const mpz_class &above = b.number->get_num(), &below = b.number->get_den();
    if (!above.fits_sint_p() || !below.fits_uint_p()) return {};
    const Value base = known(root(*a.number, below.get_ui()));
    if (!base.number) return {};
    const Value result = known(power(*base.number, mpz_class(::abs(above)).get_ui()));
    return above < 0 ? div(number(1), result) : result;
  }

  Value lt(const Value& a, const Value& b) { return both(a, b) ? truth(*a.number < *b.number) : Value{}; }
  Value le(const Value& a, const Value& b) { return both(a, b) ? truth(*a.number <= *b.number) : Value{}; }
  Value and_(const Value& a, const Value& b) {
    if (a.truth == false || b.truth == false) return truth(false);
    return a.truth && b.truth ? truth(true) : Value{};
  }
  Value not_(const Value& a) { return a.truth ? truth(!*a.truth) : Value{}; }
  Value or_(const Value& a, const Value& b) { return not_(and_(not_(a), not_(b))); }
  Value select(const Value& c, const Value& a, const Value& b) {
    return c.truth ? (*c.truth ? a : b) : Value{};
  }

 private:
  static bool both(const Value& a, const Value& b) { return a.number && b.number; }
  static Value known(Number a) { return a ? number(*std::move(a)) : Value{}; }
};

}  // namespace

std::optional<mpq_class> Rationals::operator()(Id node) {
  for (const Id id : unseen_operands(node))
    if (Value now = value(id); now.number || now.truth) values_.emplace(id, std::move(now));
  return known(node).number;
}

// What the node is made of and itself, operands first.
std::vector<Id> Rationals::unseen_operands(Id node) {
  seen_.resize(graph_.size());
  std::vector<Id> open{node}, result;
  while (!open.empty()) {
    const Id id = open.back();
    open.pop_back();
    if (seen_[id.index]) continue;
    seen_[id.index] = true;
    result.push_back(id);
    for (const Id arg : graph_[id].args) open.push_back(arg);
  }
  std::ranges::sort(result);
  return result;
}

Value Rationals::known(Id node) const {
  const auto it = values_.find(node);
  return it == values_.end() ? Value{} : it->second;
}

Value Rationals::value(Id node) const {
  if (const auto constant = graph_.number(node))
    return std::isfinite(*constant) ? number(mpq_class(*constant)) : Value{};
  if (const auto constant = graph_.truth_value(node)) return truth(*constant);
  std::vector<Value> args;
  for (const Id arg : graph_[node].args) args.push_back(known(arg));
  RationalRules rules;
  return apply(rules, graph_[node].op, std::span<const Value>(args)).value_or(Value{});
}

}  // namespace imp::syntax
