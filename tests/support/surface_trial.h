// Inclusion functions of the catalogue's surfaces on random boxes in their domains: every value lies
// within; and how wide they are beside the range.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "passes/extend/inclusion.h"
#include "passes/precision.h"
#include "runtime/kernel.h"
#include "runtime/numbers.h"
#include "tests/support/ball.h"
#include "tests/support/boxes.h"
#include "tests/support/catalogue.h"

namespace imp::test {

using Box3 = std::array<Box1, 3>;
using Point3 = std::array<double, 3>;

// A surface ready for trials.
class TriedSurface {
 public:
  explicit TriedSurface(const SurfaceEntry& entry) : entry_(&entry), model_(model_of(entry)) {
    Diagnostics diagnostics;
    uniforms_ = uniform_values(model_, {}, std::nullopt, diagnostics).value();
  }

  const SurfaceEntry& entry() const { return *entry_; }
  const Program& f() const { return model_.surfaces[0].f; }
  const std::vector<double>& uniforms() const { return uniforms_; }

  // The enclosure as a kernel; nothing where the form has no rule for an op, or the backend refuses.
  std::unique_ptr<Kernel> enclosure(const Inclusion& form, Type type, const KernelOptions& options) const {
    Diagnostics diagnostics;
    auto program = extension(f(), *form.enclose, type, diagnostics);
    if (!program) return nullptr;
    auto kernel = make_kernel(*std::move(program), options);
    return kernel ? *std::move(kernel) : nullptr;
  }

  Ball value(const Point3& p) const {
    std::vector<double> inputs(p.begin(), p.end());
    inputs.insert(inputs.end(), uniforms_.begin(), uniforms_.end());
    return ball_values(f(), inputs)[0];
  }

  struct Enclosures {
    Column lo, hi, defined;
  };
  Enclosures enclose(const Kernel& kernel, const std::vector<Box3>& boxes) const {
    std::vector<Column> columns(6);
    for (const Box3& box : boxes)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        columns[2 * axis].push_back(box[axis].lo);
        columns[2 * axis + 1].push_back(box[axis].hi);
      }
    for (const double uniform : uniforms_) columns.insert(columns.end(), 2, Column{uniform});
    auto result = run_rows(kernel, columns, boxes.size());
    return {std::move(result[0]), std::move(result[1]), std::move(result[2])};
  }

  // Values in double, quickly.
  std::unique_ptr<Kernel> values_kernel() const {
    auto kernel = make_kernel(in_precision(f(), f64), {.precision = f64});
    return kernel ? *std::move(kernel) : nullptr;
  }
  Column values(const Kernel& kernel, const std::vector<Point3>& points) const {
    std::vector<Column> columns(3);
    for (const Point3& p : points)
      for (std::size_t axis = 0; axis < 3; ++axis) columns[axis].push_back(p[axis]);
    for (const double uniform : uniforms_) columns.push_back({uniform});
    return run_rows(kernel, columns, points.size())[0];
  }

 private:
  const SurfaceEntry* entry_;
  Model model_;
  std::vector<double> uniforms_;
};

// Boxes from the whole domain down to 2^-20 of it, on each axis by itself.
inline std::vector<Box3> boxes_in(const Domain& domain, std::uint64_t seed, std::size_t count) {
  Boxes random(seed);
  std::vector<Box3> result(count);
  for (Box3& box : result)
    for (std::size_t axis = 0; axis < 3; ++axis) box[axis] = random.within(domain.lo[axis], domain.hi[axis]);
  return result;
}

struct SurfaceCount {
  std::uint64_t boxes = 0, values = 0, undecided = 0, misses = 0, overclaimed = 0;
  std::string first;

  void add(const SurfaceCount& other) {
    if (first.empty()) first = other.first;
    boxes += other.boxes, values += other.values, undecided += other.undecided;
    misses += other.misses, overclaimed += other.overclaimed;
  }
};

// `points` places in each box, at its corners as often as not.
inline SurfaceCount try_surface(const TriedSurface& surface, std::span<const Kernel* const> kernels,
                                std::uint64_t seed, std::size_t count, std::size_t points) {
  const auto boxes = boxes_in(surface.entry().domain, seed, count);
  std::vector<TriedSurface::Enclosures> enclosures;
  for (const Kernel* kernel : kernels) enclosures.push_back(surface.enclose(*kernel, boxes));

  SurfaceCount result;
  Boxes random(~seed);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < points; ++k) {
      Point3 p;
      for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = random.inside(boxes[i][axis]);
      const Ball value = surface.value(p);
      result.undecided += value.is(Ball::State::unknown) ? 1 : 0;
      for (std::size_t which = 0; which < kernels.size(); ++which) {
        const auto& [lo, hi, defined] = enclosures[which];
        ++result.values;
        const bool missed = value.certainly_outside(lo[i], hi[i]);
        const bool overclaimed = value.is(Ball::State::none) && defined[i] != 0;
        result.misses += missed ? 1 : 0;
        result.overclaimed += overclaimed ? 1 : 0;
        if ((missed || overclaimed) && result.first.empty())
          result.first = fmt::format(
              "kernel {}: at {:a}, {:a}, {:a} it is {:a}, in [{:a}, {:a}] over [{:a}, "
              "{:a}] x [{:a}, {:a}] x [{:a}, {:a}]",
              which, p[0], p[1], p[2], value.nearest(), lo[i], hi[i], boxes[i][0].lo, boxes[i][0].hi,
              boxes[i][1].lo, boxes[i][1].hi, boxes[i][2].lo, boxes[i][2].hi);
      }
    }
  result.boxes = count * kernels.size();
  return result;
}

}  // namespace imp::test
