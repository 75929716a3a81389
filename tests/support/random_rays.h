// Random rays through a domain: chords, rays from outside, and rays that graze the surface.
#pragma once

#include "ir/infinity.h"
#include "tests/support/dense_roots.h"
#include "tests/support/random.h"

namespace imp::test {

class RandomRays {
 public:
  RandomRays(const Domain& domain, std::uint64_t seed) : domain_(domain), random_(seed) {}

  // A half of them chords, a quarter from outside, a quarter grazing; the last where there is a surface.
  Ray next(const DenseSearch& search) {
    switch (random_.below(4)) {
      case 0:  return from_outside();
      case 1:  return grazing(search).value_or(chord());
      default: return chord();
    }
  }

 private:
  using Point3 = std::array<double, 3>;

  static double dot(const Point3& a, const Point3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static Point3 at(const Ray& ray, double t) {
    return {ray.o[0] + t * ray.d[0], ray.o[1] + t * ray.d[1], ray.o[2] + t * ray.d[2]};
  }
  double half(std::size_t axis) const { return (domain_.hi[axis] - domain_.lo[axis]) / 2; }

  Point3 direction() {  // of length 1
    for (;;) {
      Point3 v;
      for (double& x : v) x = random_.between(-1, 1);
      const double square = dot(v, v);
      if (square > 1 || square < 0.01) continue;
      for (double& x : v) x /= std::sqrt(square);
      return v;
    }
  }
  // A point of the domain made smaller by `share`.
  Point3 inside(double share = 1) {
    for (;;) {
      Point3 unit, p;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        unit[axis] = random_.between(-share, share);
        p[axis] = (domain_.lo[axis] + domain_.hi[axis]) / 2 + half(axis) * unit[axis];
      }
      if (!domain_.sphere || dot(unit, unit) <= share * share) return p;
    }
  }

  // Clipped to the box around the domain.
  Ray clipped(const Point3& o, const Point3& d) const {
    Ray ray{o, d, -infinity, infinity};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (d[axis] == 0) continue;
      const double a = (domain_.lo[axis] - o[axis]) / d[axis], b = (domain_.hi[axis] - o[axis]) / d[axis];
      ray.tmin = std::max(ray.tmin, std::min(a, b)), ray.tmax = std::min(ray.tmax, std::max(a, b));
    }
    return ray;
  }

  Ray chord() { return clipped(inside(), direction()); }

  Ray from_outside() {
    const Point3 aim = inside(1.0 / 3), d = direction();
    const double back = 3 * std::max({half(0), half(1), half(2)});
    return clipped({aim[0] - back * d[0], aim[1] - back * d[1], aim[2] - back * d[2]}, d);
  }

  // In a plane that touches the surface, or beside it by a power of two.
  std::optional<Ray> grazing(const DenseSearch& search) {
    const Ray through = chord();
    const auto crossing = search(through).crossing;
    if (!crossing) return std::nullopt;
    const Point3 place = at(through, crossing->middle());
    Point3 normal = search.place(through, crossing->middle()).gradient;
    const double length = std::sqrt(dot(normal, normal));
    if (!(length > 0) || !std::isfinite(length)) return std::nullopt;
    for (double& x : normal) x /= length;

    Point3 d = direction(), o = place;
    const double along = dot(d, normal);
    for (std::size_t axis = 0; axis < 3; ++axis) d[axis] -= along * normal[axis];
    const double aside =
        (random_.one_in(2) ? 1 : -1) * std::ldexp(half(0), -static_cast<int>(random_.below(40)) - 4);
    for (std::size_t axis = 0; axis < 3; ++axis) o[axis] += aside * normal[axis];
    const Ray ray = clipped(o, d);
    if (!(ray.tmin < ray.tmax)) return std::nullopt;
    return ray;
  }

  const Domain domain_;
  Random random_;
};

}  // namespace imp::test
