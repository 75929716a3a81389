// What is proven of the roots of a formula along a ray, by bisection with sets of real numbers, and what that
// says of an answer. What takes more than the effort stays open.
#pragma once

#include <array>
#include <string>

#include "runtime/search/search.h"
#include "tests/support/cast.h"
#include "tests/support/real_function.h"

namespace imp::test {

// A formula along o + t d.
class RealRay {
 public:
  RealRay(const RealFunction& f, const Ray& ray, std::span<const double> uniforms) : f_(&f) {
    for (std::size_t i = 0; i < 3; ++i) o_[i] = Real(ray.o[i]), d_[i] = Real(ray.d[i]);
    inputs_.resize(f.inputs());
    for (std::size_t i = 3; i < f.inputs(); ++i) inputs_[i] = {Real(uniforms[i - 3]), Real(uniforms[i - 3])};
    if (ray.time) inputs_.back() = {Real(*ray.time), Real(*ray.time)};
  }
  Outcome operator()(const Real& a, const Real& b) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const bool falls = d_[i].sign() < 0;
      inputs_[i].lo = add(o_[i], mul(d_[i], falls ? b : a, Toward::below), Toward::below);
      inputs_[i].hi = add(o_[i], mul(d_[i], falls ? a : b, Toward::above), Toward::above);
    }
    return (*f_)(inputs_);
  }
  Outcome operator()(const Real& t) const { return (*this)(t, t); }

 private:
  const RealFunction* f_;
  std::array<Real, 3> o_, d_;
  mutable std::vector<RealSet> inputs_;
};

// The roots of one formula, from the near end on until one is proven.
class RayTruth {
 public:
  static constexpr int effort = 500;          // evaluations until the first root
  static constexpr int effort_closely = 120;  // and around an answer

  RayTruth(const RealFunction& f, const Ray& ray, std::span<const double> uniforms)
      : f_(f, ray, uniforms), near_(ray.tmin), far_(ray.tmax) {
    finest_ = mul(add(far_, -near_, Toward::above), Real(0x1p-20), Toward::above);
    if (ray.tmin <= ray.tmax) scan();
  }

  // Whether all before t is proven to be free of roots.
  bool free_before(const Real& t) const { return open_.empty() || open_.front().a >= t; }
  // Whether a root is proven that lies before t.
  bool root_before(const Real& t) const { return root_ && root_->b < t; }
  bool has_root() const { return root_.has_value(); }
  bool is_free() const { return open_.empty() && !root_; }
  // Whether there is proven to be a change of sign between a and b, where f is continuous.
  bool crosses(const Real& a, const Real& b) const {
    return root_ && root_->changes && a <= root_->a && root_->b <= b;
  }
  // Whether there is proven to be none.
  bool crosses_nowhere(const Real& a, const Real& b) const {
    bool zero = false, below = false, above = false;
    std::vector<Piece> pieces{{a, b}};
    for (int left = effort_closely; !pieces.empty(); --left) {
      const Piece piece = pieces.back();
      pieces.pop_back();
      const Outcome f = f_(piece.a, piece.b);
      if (f.may_be_zero && f.may_be_below && f.may_be_above && piece.a < piece.b && left > 0) {
        const Real middle = half_way(piece.a, piece.b);
        pieces.push_back({middle, piece.b}), pieces.push_back({piece.a, middle});
        continue;
      }
      zero |= f.may_be_zero, below |= f.may_be_below, above |= f.may_be_above;
      if (zero && below && above) return false;
    }
    return true;
  }
  std::string text() const {
    if (!root_) return open_.empty() ? "no root" : "no root known";
    return fmt::format("{} in [{}, {}]", root_->changes ? "a root" : "a zero", root_->a.nearest(),
                       root_->b.nearest());
  }

 private:
  struct Piece {
    Real a, b;
    bool changes = false;
  };

  // From the near end on: pieces of a millionth of the ray that may hold a root are left open.
  void scan() {
    std::vector<Piece> pieces{{near_, far_}};
    for (int left = effort; !pieces.empty(); --left) {
      const Piece piece = pieces.back();
      if (left <= 0) {
        open_.push_back({piece.a, far_});
        return probe(piece.a);
      }
      pieces.pop_back();
      const Outcome f = f_(piece.a, piece.b);
      if (!f.may_be_zero) continue;
      if (add(piece.b, -piece.a, Toward::above) > finest_) {
        const Real middle = half_way(piece.a, piece.b);
        pieces.push_back({middle, piece.b}), pieces.push_back({piece.a, middle});
        continue;
      }
      left -= 2;
      if (prove(piece, f.continuous)) return;
      if (open_.empty() || open_.back().b < piece.a)
        open_.push_back(piece);
      else
        open_.back().b = piece.b;
    }
  }
  // Signs here and there behind what could be searched.
  void probe(const Real& from) {
    constexpr int points = 64;
    const Real step = mul(add(far_, -from, Toward::below), Real(1.0 / points), Toward::below);
    Real a = from;
    int sign = f_(a).sign();
    for (int i = 1; i <= points; ++i) {
      const Real b = i == points ? far_ : add(a, step, Toward::below);
      const Outcome f = f_(b);
      if (prove_at(b, f)) return;
      if (sign * f.sign() < 0 && closer(a, b, sign)) return;
      a = b, sign = f.sign();
    }
  }
  bool closer(Real a, Real b, int sign) {  // signs differ at a and b
    for (int i = 0; i < 40; ++i) {
      if (f_(a, b).continuous) {
        root_ = Piece{a, b, true};
        if (i > 24) return true;
      }
      const Real middle = half_way(a, b);
      const int there = f_(middle).sign();
      if (there == 0) break;
      (there == sign ? a : b) = middle;
    }
    return root_.has_value();
  }
  bool prove(const Piece& piece, bool continuous) {
    const Outcome a = f_(piece.a), b = f_(piece.b);
    if (prove_at(piece.a, a) || prove_at(piece.b, b)) return true;
    if (!continuous || a.sign() * b.sign() >= 0) return false;
    root_ = Piece{piece.a, piece.b, true};
    return true;
  }
  bool prove_at(const Real& t, const Outcome& f) {
    if (!f.is_zero()) return false;
    const Real a = std::max(near_, add(t, -finest_, Toward::below));
    const Real b = std::min(far_, add(t, finest_, Toward::above));
    const bool changes = f_(a).sign() * f_(b).sign() < 0 && f_(a, b).continuous;
    root_ = changes ? Piece{a, b, true} : Piece{t, t, false};
    return true;
  }

  RealRay f_;
  Real near_, far_, finest_;
  std::vector<Piece> open_;  // before the root
  std::optional<Piece> root_;
};

enum class Proof : std::uint8_t { right, open, wrong, undecided };

// An answer for a ray at one or several surfaces; `slack` is what t may be off beside.
inline Proof proof_of(std::span<const RayTruth> surfaces, const Ray& ray, const Answer& answer,
                      double slack = 0) {
  if (answer.verdict == verdict_undecided) return Proof::undecided;
  if (answer.verdict == verdict_miss) {
    bool right = true;
    for (const RayTruth& surface : surfaces) {
      if (surface.has_root()) return Proof::wrong;
      right &= surface.is_free();
    }
    return right ? Proof::right : Proof::open;
  }
  if (!(ray.tmin <= answer.t && answer.t <= ray.tmax)) {
    const double out = std::max(ray.tmin - answer.t, answer.t - ray.tmax);
    if (!(out <= slack)) return Proof::wrong;
  }
  // t itself is rounded to a double.
  const double rounding = std::ldexp(std::abs(answer.t), -52) + slack;
  const Real length = add(Real(ray.tmax), Real(-ray.tmin), Toward::above);
  const Real tolerance =
      add(mul(length, Real(certified_length), Toward::above), Real(rounding), Toward::above);
  const Real before = add(Real(answer.t), -tolerance, Toward::below);
  const Real a = std::max(Real(ray.tmin), before);
  const Real b = std::min(Real(ray.tmax), add(Real(answer.t), tolerance, Toward::above));

  bool free = true, crosses = false;
  for (const RayTruth& surface : surfaces) {
    if (surface.root_before(before)) return Proof::wrong;
    free &= surface.free_before(before), crosses |= surface.crosses(a, b);
  }
  if (crosses) return free ? Proof::right : Proof::open;
  for (const RayTruth& surface : surfaces)
    if (!surface.crosses_nowhere(a, b)) return Proof::open;
  return Proof::wrong;
}

}  // namespace imp::test
