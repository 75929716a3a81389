// Whether a certified answer is right: by dense samples, and where these contradict it or are in doubt, by ball
// arithmetic at single places of exactly that ray.
#pragma once

#include <string>

#include "ir/infinity.h"
#include "passes/along_ray.h"
#include "tests/support/ball.h"
#include "tests/support/dense_roots.h"

namespace imp::test {

enum class Judgement : std::uint8_t {
  right,
  wrong,     // the signs at some places of the ray prove it
  doubtful,  // certified where the reference does not know
  undecided
};

class Judge {
 public:
  explicit Judge(const Model& model, std::size_t samples = 2048, const std::vector<Override>& overrides = {})
      : dense_(model, samples, overrides),
        along_(along_ray(model.surfaces.at(0).f)),
        moves_(model.time.has_value()) {
    Diagnostics diagnostics;
    uniforms_ = uniform_values(model, overrides, std::nullopt, diagnostics).value();
  }

  const DenseSearch& dense() const { return dense_; }
  DenseRoots roots(const Ray& ray) const { return dense_(ray); }

  Judgement operator()(const Ray& ray, const DenseRoots& known, const Answer& answer) const {
    if (answer.verdict == verdict_undecided) return Judgement::undecided;
    return answer.verdict == verdict_hit ? of_hit(ray, known, answer.t) : of_miss(ray, known);
  }

 private:
  // The sign of f, or what else there is.
  enum class At : std::int8_t { below = -1, zero = 0, above = 1, unknown, nowhere };

  At at(const Ray& ray, double t) const {
    std::vector<double> inputs{t};
    inputs.insert(inputs.end(), ray.o.begin(), ray.o.end());
    inputs.insert(inputs.end(), ray.d.begin(), ray.d.end());
    inputs.insert(inputs.end(), uniforms_.begin(), uniforms_.end());
    if (moves_ && ray.time) inputs.back() = *ray.time;
    const Ball value = ball_values(along_, inputs).front();
    if (value.is(Ball::State::none)) return At::nowhere;
    if (!value.is(Ball::State::number)) return At::unknown;
    if (arb_is_zero(value.get())) return At::zero;
    return arb_is_positive(value.get()) ? At::above : arb_is_negative(value.get()) ? At::below : At::unknown;
  }

  static bool is_sign(At a) { return a == At::below || a == At::above; }
  static bool opposite(At a, At b) { return is_sign(a) && is_sign(b) && a != b; }

  // Whether there is a root within a billionth of the segment: closer to one the signs of doubles are chance.
  bool certain(const Ray& ray, const DenseRoots::Bracket& crossing) const {
    for (const double share : {0.0, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9}) {
      const double beside = share * (ray.tmax - ray.tmin);
      if (opposite(at(ray, std::max(ray.tmin, crossing.lo - beside)),
                   at(ray, std::min(ray.tmax, crossing.hi + beside))))
        return true;
    }
    return false;
  }

  // Of an answer that is right if no doubtful place before `end` holds a root.
  Judgement unless_a_root(const Ray& ray, const std::vector<Doubt>& doubts, double end) const {
    Judgement result = Judgement::right;
    for (const Doubt& doubt : doubts) {
      if (doubt.t >= end) continue;
      const At there = at(ray, doubt.t);
      if (there == At::zero || (is_sign(there) && doubt.sign == -static_cast<int>(there)))
        return Judgement::wrong;
      const bool touches =
          std::abs(dense_.place(ray, doubt.t).f) <= 1e-9 * doubt.scale;  // as far as doubles tell
      if (doubt.sign == 0 || !is_sign(there) || touches) result = Judgement::doubtful;
    }
    return result;
  }

  Judgement of_miss(const Ray& ray, const DenseRoots& known) const {
    if (known.crossing) return certain(ray, *known.crossing) ? Judgement::wrong : Judgement::doubtful;
    return unless_a_root(ray, known.doubts, infinity);
  }

  Judgement of_hit(const Ray& ray, const DenseRoots& known, double t) const {
    const double tolerance = 2e-5 * (ray.tmax - ray.tmin);
    if (!(ray.tmin <= t && t <= ray.tmax)) return Judgement::wrong;
    if (known.crossing && known.crossing->hi < t - tolerance)
      return certain(ray, *known.crossing) ? Judgement::wrong : Judgement::doubtful;
    if (known.crossing && known.crossing->lo <= t + tolerance)
      return unless_a_root(ray, known.doubts, t - tolerance);

    // A pair of roots that fell between the samples, or nothing.
    Ray around = ray;
    around.tmin = std::max(ray.tmin, t - tolerance), around.tmax = std::min(ray.tmax, t + tolerance);
    const DenseRoots closely = dense_(around);
    if (closely.crossing)
      return certain(ray, *closely.crossing) ? unless_a_root(ray, known.doubts, t - tolerance)
                                             : Judgement::doubtful;
    for (const double end : {around.tmin, around.tmax})
      if (!is_sign(at(ray, end))) return Judgement::doubtful;
    const bool no_root = unless_a_root(ray, closely.doubts, around.tmax) == Judgement::right;
    return no_root ? Judgement::wrong : Judgement::doubtful;
  }

  DenseSearch dense_;
  Program along_;
  bool moves_;
  UniformValues uniforms_;
};

}  // namespace imp::test
