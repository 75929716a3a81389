// First roots along rays by brute force, to compare searches with: f and its slope in double at thousands of
// places along a ray, then the changes of sign between neighbours and the extrema between them. With the searches
// it shares the formula and its gradient, and nothing of what is made for rays. It is as good as doubles at these
// places; where it contradicts a certified answer, tests/support/judge.h asks ball arithmetic.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "tests/support/cast.h"

namespace imp::test {

// Where f may touch zero, has no value, or jumps.
struct Doubt {
  double t;
  int sign;          // of f on both sides; 0 where that is not known
  double scale = 0;  // of f beside it; 0 where that is not known
};

struct DenseRoots {
  struct Bracket {
    double lo, hi;  // f has opposite signs here
    double middle() const { return lo + (hi - lo) / 2; }
  };
  std::optional<Bracket> crossing;  // the first
  std::vector<Doubt> doubts;        // before it, or all along where there is none
  bool easy = false;                // as easy as is_hard (surface_data.h) is not, and no root near an end
};

class DenseSearch {
 public:
  explicit DenseSearch(const Model& model, std::size_t samples = 2048,
                       const std::vector<Override>& overrides = {})
      : samples_(samples), moves_(model.time.has_value()) {
    Diagnostics diagnostics;
    auto uniforms = uniform_values(model, overrides, std::nullopt, diagnostics);
    auto program = evaluation_program(model.surfaces.at(0), Evaluation::gradient, f64, diagnostics);
    if (!uniforms || !program) throw std::runtime_error(to_text(diagnostics));
    uniforms_ = *std::move(uniforms);
    kernel_ = kernel_of(*std::move(program), {.precision = f64});
  }

  DenseRoots operator()(const Ray& ray) const {
    Scan scan{*this, ray, (ray.tmax - ray.tmin) / static_cast<double>(samples_), {}, {}};
    for (std::size_t i = 0; i <= samples_; ++i)
      scan.t.push_back(i == samples_ ? ray.tmax : ray.tmin + static_cast<double>(i) * scan.step);
    scan.places = places(ray, scan.t);
    return scan.run();
  }

  // What there is at one place of a ray.
  struct Place {
    double f, slope;  // slope: df/dt
    std::array<double, 3> gradient;
  };
  std::vector<Place> places(const Ray& ray, std::span<const double> t) const {
    std::vector<Column> columns(3);
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const double each : t) columns[axis].push_back(ray.o[axis] + each * ray.d[axis]);
    for (const double value : uniforms_) columns.push_back({value});
    if (moves_ && ray.time) columns.back() = {*ray.time};
    const auto out = run_rows(*kernel_, columns, t.size());
    std::vector<Place> result;
    for (std::size_t i = 0; i < t.size(); ++i) {
      const std::array gradient{out[1][i], out[2][i], out[3][i]};
      result.push_back(
          {out[0][i], gradient[0] * ray.d[0] + gradient[1] * ray.d[1] + gradient[2] * ray.d[2], gradient});
    }
    return result;
  }
  Place place(const Ray& ray, double t) const { return places(ray, std::span(&t, 1)).front(); }

 private:
  using Bracket = DenseRoots::Bracket;

  static int sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }  // NaN: 0

  // One ray.
  struct Scan {
    const DenseSearch& search;
    const Ray& ray;
    double step;
    std::vector<double> t;
    std::vector<Place> places;

    DenseRoots run() {
      DenseRoots found;
      bool near = false;  // an almost-root or a second root: not easy
      std::size_t last = t.size() - 1;
      for (std::size_t i = 0; i < last; ++i) {
        const Place &a = places[i], &b = places[i + 1];
        const int sign_a = sign(a.f), sign_b = sign(b.f);
        if (std::isnan(a.f) || std::isnan(b.f)) {
          near = true;
          if (!found.crossing && std::isnan(a.f) != std::isnan(b.f)) edge(i, found);
          continue;
        }
        if (sign_a == 0 || sign_b == 0) {
          near = true;
          if (!found.crossing && sign_a == 0) found.doubts.push_back({t[i], around(i)});
          if (!found.crossing && sign_b == 0 && i + 1 == last) found.doubts.push_back({t[last], 0});
          if (!found.crossing && sign_a == 0 && i > 0) cross({t[i - 1], t[i + 1]}, found);
          continue;
        }
        std::optional<Bracket> crossing;
        if (sign_a != sign_b) crossing = {t[i], t[i + 1]};
        if (turns_back(a, b, sign_a)) {
          const double extremum =
              section({t[i], t[i + 1]}, -sign_a, [](const Place& p) { return p.slope; }).middle();
          const Place there = search.place(ray, extremum);
          const double bend = std::abs(b.slope - a.slope) / step;
          near = near || sign(there.f) != sign_a || std::sqrt(2 * std::abs(there.f) / bend) < margin();
          if (sign(there.f) == -sign_a)
            crossing = {t[i], extremum};
          else if (!found.crossing &&
                   !(std::abs(there.f) > doubtful * std::max(std::abs(a.f), std::abs(b.f))))
            found.doubts.push_back({extremum, sign_a, std::max(std::abs(a.f), std::abs(b.f))});
        }
        if (crossing && found.crossing) near = true;
        if (crossing && !found.crossing && cross(*crossing, found))
          last = std::min(last, i + 2 + static_cast<std::size_t>(margin() / step));
      }
      found.easy = found.doubts.empty() && !near && !at_an_end(found);
      return found;
    }

    // |f| falls at a and rises at b, by enough to come near to zero between them.
    bool turns_back(const Place& a, const Place& b, int sign_a) const {
      return sign(b.f) == sign_a && sign_a * a.slope < 0 && sign_a * b.slope > 0 &&
             std::min(std::abs(a.f), std::abs(b.f)) < 4 * step * std::abs(b.slope - a.slope);
    }

    // The sign on both sides of place i, 0 if there are two.
    int around(std::size_t i) const {
      if (i == 0 || i + 1 == places.size()) return 0;
      const int before = sign(places[i - 1].f), after = sign(places[i + 1].f);
      return before == after ? before : 0;
    }

    // Between two places f ceases to have values, or begins to.
    void edge(std::size_t i, DenseRoots& found) const {
      const bool ceases = std::isnan(places[i + 1].f);
      const auto defined = [](const Place& p) { return std::isnan(p.f) ? -1.0 : 1.0; };
      const Bracket last = section({t[i], t[i + 1]}, ceases ? 1 : -1, defined);
      const double end = ceases ? last.lo : last.hi;
      const Place at_end = search.place(ray, end), &within = places[ceases ? i : i + 1];
      if (sign(at_end.f) * sign(within.f) < 0)
        cross(ceases ? Bracket{t[i], end} : Bracket{end, t[i + 1]}, found);
      else if (!(std::abs(at_end.f) > 1e-3 * std::abs(within.f)))
        found.doubts.push_back({end, 0});
    }

    // Whether f has a root in the bracket, which is noted then; or it jumps there, or has a pole.
    bool cross(Bracket bracket, DenseRoots& found) const {
      const auto value = [](const Place& p) { return p.f; };
      const Place a = search.place(ray, bracket.lo), b = search.place(ray, bracket.hi);
      if (sign(a.f) * sign(b.f) >= 0) return false;
      const Bracket root = section(bracket, sign(a.f), value);
      const double left =
          std::max(std::abs(search.place(ray, root.lo).f), std::abs(search.place(ray, root.hi).f));
      const double beside = std::max(std::abs(a.f), std::abs(b.f));
      if (!(left <= 1e-2 * beside) || std::isinf(beside)) {
        found.doubts.push_back({root.middle(), 0});
        return false;
      }
      found.crossing = root;
      return true;
    }

    // Cuts a bracket into sixteen, again and again, to where `value` loses the sign that it has at the low end.
    template <class Value>
    Bracket section(Bracket bracket, int sign_lo, Value value) const {
      constexpr int parts = 16;
      for (int round = 0; round < 9; ++round) {
        std::vector<double> cuts;
        for (int k = 1; k < parts; ++k) cuts.push_back(std::lerp(bracket.lo, bracket.hi, k / double{parts}));
        const auto there = search.places(ray, cuts);
        for (std::size_t k = 0; k < cuts.size(); ++k) {
          if (sign(value(there[k])) == sign_lo) {
            bracket.lo = cuts[k];
          } else {
            bracket.hi = cuts[k];
            break;
          }
        }
      }
      return bracket;
    }

    double margin() const { return 1e-3 * (ray.tmax - ray.tmin); }

    // A root may lie just inside or just beyond an end of the segment.
    bool at_an_end(const DenseRoots& found) const {
      const double close = 0.1 * margin();
      const auto almost = [&](const Place& p) { return !(std::abs(p.f) > close * std::abs(p.slope)); };
      return almost(places.front()) || (!found.crossing && almost(places.back())) ||
             (found.crossing && ray.tmax - found.crossing->hi < close);
    }
  };

  static constexpr double doubtful = 1e-6;

  std::size_t samples_;
  bool moves_;
  UniformValues uniforms_;
  std::unique_ptr<Kernel> kernel_;
};

}  // namespace imp::test
