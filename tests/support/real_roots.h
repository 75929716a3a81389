// Real roots of polynomials by Sturm's theorem in rational arithmetic: nothing is rounded. And with them, whether an
// answer is right on a ray at a polynomial surface.
#pragma once

#include <string>

#include "tests/support/cast.h"
#include "tests/support/ray_pieces.h"

namespace imp::test {

class RealRoots {
 public:
  explicit RealRoots(RationalPolynomial p) : p_(trimmed(std::move(p))) {
    if (p_.empty()) return;
    RationalPolynomial a = p_, b = derivative(p_);
    while (!b.empty()) a = std::exchange(b, remainder(a, b).second);
    const RationalPolynomial simple = remainder(p_, a).first;  // by gcd(p, p'): each root once
    sequence_ = {simple, derivative(simple)};
    while (!sequence_.back().empty()) {
      RationalPolynomial next = remainder(sequence_[sequence_.size() - 2], sequence_.back()).second;
      for (Rational& c : next) c = -c;
      sequence_.push_back(std::move(next));
    }
  }

  bool everywhere() const { return p_.empty(); }
  int sign(const Rational& x) const { return sgn(value(p_, x)); }

  // Different roots in [a, b].
  std::size_t count(const Rational& a, const Rational& b) const {
    return variations(a) - variations(b) + (sign(a) == 0 ? 1 : 0);
  }

 private:
  static RationalPolynomial trimmed(RationalPolynomial p) {
    while (!p.empty() && p.back() == 0) p.pop_back();
    return p;
  }
  static RationalPolynomial derivative(const RationalPolynomial& p) {
    RationalPolynomial result;
    for (std::size_t i = 1; i < p.size(); ++i)
      result.push_back(p[i] * Rational(static_cast<unsigned long>(i)));
    return result;
  }
  static Rational value(const RationalPolynomial& p, const Rational& x) {
    Rational sum = 0;
    for (std::size_t i = p.size(); i-- > 0;) sum = sum * x + p[i];
    return sum;
  }
  // The quotient and the remainder.
  static std::pair<RationalPolynomial, RationalPolynomial> remainder(RationalPolynomial a,
                                                                     const RationalPolynomial& b) {
    RationalPolynomial quotient(a.size() < b.size() ? 0 : a.size() - b.size() + 1);
    while (a.size() >= b.size()) {
      const std::size_t shift = a.size() - b.size();
      const Rational factor = a.back() / b.back();
      quotient[shift] = factor;
      for (std::size_t i = 0; i + 1 < b.size(); ++i) a[i + shift] -= factor * b[i];
      a.pop_back();
      a = trimmed(std::move(a));
    }
    return {quotient, a};
  }

  std::size_t variations(const Rational& x) const {
    std::size_t changes = 0;
    int last = 0;
    for (const RationalPolynomial& p : sequence_) {
      const int now = sgn(value(p, x));
      if (now != 0 && last != 0 && now != last) ++changes;
      if (now != 0) last = now;
    }
    return changes;
  }

  RationalPolynomial p_;
  std::vector<RationalPolynomial> sequence_;
};

// What is wrong with an answer, or nothing. `f` is a polynomial with rational coefficients, without uniforms, whose
// zeros are the surface; the ray's numbers are finite. `slack` is what rounding t may have moved it by.
inline std::string exact_mistake(const Program& f, const Ray& ray, const Answer& answer, double slack = 0) {
  if (answer.verdict == verdict_undecided) return "";
  const bool hit = answer.verdict == verdict_hit;
  if (ray.tmin > ray.tmax) return hit ? "a hit where the ray has no points" : "";
  const RealRoots roots(exact_along(f, {ray.tmin, ray.tmax, ray.o, ray.d, 0}));
  if (roots.everywhere()) return "certified, but f is 0 all along";
  const auto all = roots.count(0, 1);
  if (!hit) return all == 0 ? "" : fmt::format("a miss with {} roots", all);

  if (!(ray.tmin <= answer.t && answer.t <= ray.tmax)) return fmt::format("hit at {}, outside", answer.t);
  if (ray.tmin == ray.tmax) return "a hit on a single point";
  const Rational length = Rational(ray.tmax) - Rational(ray.tmin);
  const Rational tolerance = Rational(2e-5) + Rational(slack) / length;
  const Rational u = (Rational(answer.t) - Rational(ray.tmin)) / length;
  const Rational lo = u > tolerance ? u - tolerance : Rational(0);
  const Rational hi = u + tolerance < 1 ? u + tolerance : Rational(1);
  const auto before = roots.count(0, lo), near = roots.count(lo, hi);
  if (before > (roots.sign(lo) == 0 ? 1U : 0U))
    return fmt::format("hit at {}, with {} roots before it", answer.t, before);
  if (near == 0) return fmt::format("hit at {}, where no root is", answer.t);
  // Of roots closer together than a certified hit need tell apart, some first ones change the sign.
  if (near == 1 && roots.sign(lo) * roots.sign(hi) >= 0)
    return fmt::format("hit at {}, which is no crossing", answer.t);
  return "";
}

}  // namespace imp::test
