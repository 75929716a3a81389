// How wide the forms are beside the range of f, which is that of many values, improved by walking to
// the extremes.
#include <algorithm>
#include <numeric>

#include "tests/prove/rows.h"
#include "tests/prove/surfaces.h"
#include "tests/support/surface_trial.h"

namespace imp::prove {
namespace {

constexpr int side = 9;  // points on an edge of the first grid
constexpr int walks = 14;
constexpr int exponents[] = {-2, -5, -8};  // of the size of a box, by that of the domain

std::vector<test::Box3> boxes_of_size(const test::Domain& domain, double size, std::size_t count) {
  test::Random random(0x719);
  std::vector<test::Box3> boxes(count);
  for (test::Box3& box : boxes)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double width = (domain.hi[axis] - domain.lo[axis]) * size;
      const double lo = random.between(domain.lo[axis], domain.hi[axis] - width);
      box[axis] = {lo, lo + width};
    }
  return boxes;
}

struct Extreme {
  test::Point3 at{};
  double value = 0;
};

// The largest of sign * f over each box: NaN where f is not a number somewhere.
std::vector<Extreme> extremes(const test::TriedSurface& surface, const Kernel& kernel,
                              const std::vector<test::Box3>& boxes, double sign) {
  std::vector<Extreme> best(boxes.size());
  std::vector<test::Point3> points;
  const auto improve = [&](std::size_t candidates, bool first) {
    const Column values = surface.values(kernel, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      Extreme& e = best[i / candidates];
      const double value = sign * values[i];
      if ((first && i % candidates == 0) || value > e.value || std::isnan(value)) e = {points[i], value};
    }
    points.clear();
  };

  for (const test::Box3& box : boxes)
    for (int i = 0; i < side * side * side; ++i) {
      const int steps[] = {i % side, i / side % side, i / (side * side)};
      test::Point3& p = points.emplace_back();
      for (std::size_t axis = 0; axis < 3; ++axis)
        p[axis] = std::lerp(box[axis].lo, box[axis].hi, steps[axis] / (side - 1.0));
    }
  improve(static_cast<std::size_t>(side) * side * side, true);

  for (int walk = 0; walk < walks; ++walk) {
    for (std::size_t i = 0; i < boxes.size(); ++i)
      for (std::size_t axis = 0; axis < 3; ++axis)
        for (const double direction : {-1.0, 1.0}) {
          const test::Box1 edge = boxes[i][axis];
          const double step = direction * std::ldexp(edge.hi - edge.lo, -3 - walk / 2);
          test::Point3& p = points.emplace_back(best[i].at);
          p[axis] = std::clamp(p[axis] + step, edge.lo, edge.hi);
        }
    improve(6, false);
  }
  return best;
}

// The geometric mean of the ratios, and how many enclosures are not bounded.
struct Mean {
  double logarithms = 0;
  std::size_t count = 0, unbounded = 0;
};

std::string text(const Mean& mean) {
  if (mean.count == 0) return "-";
  const double ratio = std::exp(mean.logarithms / static_cast<double>(mean.count));
  return fmt::format("{:.{}f}{}", ratio,
                     ratio < 10     ? 2
                     : ratio < 1000 ? 1
                                    : 0,
                     mean.unbounded == 0 ? "" : "*");
}

std::string row_text(const test::SurfaceEntry& entry, std::size_t count) {
  const test::TriedSurface surface(entry);
  const auto values = surface.values_kernel();
  if (!values) return fmt::format("| {} | no kernel |", entry.id);
  std::vector<std::vector<Mean>> means;  // by form, by size
  std::vector<std::unique_ptr<Kernel>> kernels;
  for (const Inclusion& form : imp::inclusions()) kernels.push_back(surface.enclosure(form, f64, {}));
  means.resize(kernels.size());
  for (const int exponent : exponents) {
    const auto boxes = boxes_of_size(entry.domain, std::exp2(exponent), count);
    const auto most = extremes(surface, *values, boxes, 1), least = extremes(surface, *values, boxes, -1);
    for (std::size_t k = 0; k < kernels.size(); ++k) {
      Mean& mean = means[k].emplace_back();
      if (!kernels[k]) continue;
      const auto found = surface.enclose(*kernels[k], boxes);
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        const double range = most[i].value + least[i].value, width = found.hi[i] - found.lo[i];
        if (!(range > 0) || !std::isfinite(range)) continue;
        if (std::isfinite(width))
          mean.logarithms += std::log(width / range), ++mean.count;
        else
          ++mean.unbounded;
      }
    }
  }
  std::string result = fmt::format("| {} |", entry.id);
  for (const auto& sizes : means)
    result += fmt::format(" {} / {} / {} |", text(sizes[0]), text(sizes[1]), text(sizes[2]));
  return result;
}

}  // namespace

bool tightness(const SurfaceOptions& options) {
  std::string names, rule;
  for (const Inclusion& form : imp::inclusions()) names += fmt::format(" {} |", form.name), rule += " ---: |";
  fmt::print("| surface |{}\n| --- |{}\n", names, rule);
  for (const test::SurfaceEntry& entry : test::catalogue()) {
    if (!options.only.empty() && std::ranges::find(options.only, entry.id) == options.only.end()) continue;
    const std::string key =
        fmt::format("tightness-{}-{}-{}", entry.id, imp::inclusions().size(), options.samples);
    row(options.done, key,
        [&] { return row_text(entry, std::max<std::uint64_t>(options.samples / 100, 1)); });
  }
  return true;
}

}  // namespace imp::prove
