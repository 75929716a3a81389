// Enclosures of whole formulas: no value lies outside them.
#include <gtest/gtest.h>

#include "passes/pass.h"
#include "passes/precision.h"
#include "tests/support/boxes.h"
#include "tests/support/cast.h"
#include "tests/support/error_scale.h"

namespace imp {
namespace {

constexpr std::size_t box_count = 40, points_per_box = 8;

// Boxes in the domain of a surface, and points in each of them, at its corners as often as not.
struct Sample {
  std::vector<Column> boxes{6}, points{3};
};

Sample sample(const test::Domain& domain, std::uint64_t seed) {
  test::Boxes boxes(seed);
  Sample result;
  for (std::size_t i = 0; i < box_count; ++i) {
    std::array<test::Box1, 3> box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box[axis] = boxes.within(domain.lo[axis], domain.hi[axis]);
      result.boxes[2 * axis].push_back(box[axis].lo);
      result.boxes[2 * axis + 1].push_back(box[axis].hi);
    }
    for (std::size_t k = 0; k < points_per_box; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis) result.points[axis].push_back(boxes.inside(box[axis]));
  }
  return result;
}

struct Enclosures {
  Column lo, hi, defined;
};

Enclosures enclosures(const Surface& surface, const KernelOptions& options, const Sample& sample) {
  Diagnostics diagnostics;
  const auto program = evaluation_program(surface, Evaluation::interval, options.precision, diagnostics);
  if (!program) throw std::runtime_error(to_text(diagnostics));
  auto columns = run_rows(*test::kernel_of(*program, options), sample.boxes, box_count);
  return {std::move(columns[0]), std::move(columns[1]), std::move(columns[2])};
}

// The values at the points, each with what rounding may have done to it.
struct Values {
  Column f, slack;
};

Values values(const Surface& surface, const Sample& sample) {
  const Program program = run_passes(in_precision(surface.f, f64), kernel_passes());
  const auto kernel = interpret(program);
  Values result;
  result.f = run_rows(*kernel, sample.points, box_count * points_per_box)[0];
  for (std::size_t i = 0; i < result.f.size(); ++i) {
    const std::array p{sample.points[0][i], sample.points[1][i], sample.points[2][i]};
    result.slack.push_back(1e-14 * test::error_scales(program, p)[0]);
  }
  return result;
}

// Of polynomials, which are defined everywhere. An enclosure in float holds the one in double.
TEST(Inclusion, holds_every_value) {
  std::uint64_t seed = 1;
  for (const test::SurfaceEntry* entry : test::algebraic_entries()) {
    SCOPED_TRACE(entry->id);
    const Model model = test::model_of(*entry);
    const Surface& surface = model.surfaces[0];
    ASSERT_EQ(surface.f.inputs.size(), 3U);
    const Sample boxes = sample(entry->domain, ++seed);
    const auto [f, slack] = values(surface, boxes);
    const Enclosures narrow = enclosures(surface, {}, boxes);
    const Enclosures reference = enclosures(surface, {.backend = Backend::interpreter}, boxes);
    const Enclosures wide = enclosures(surface, {.precision = f64}, boxes);

    for (std::size_t i = 0; i < box_count; ++i) {
      SCOPED_TRACE(i);
      EXPECT_EQ(narrow.defined[i], 1);
      EXPECT_EQ(wide.defined[i], 1);
      EXPECT_EQ(narrow.lo[i], reference.lo[i]);
      EXPECT_EQ(narrow.hi[i], reference.hi[i]);
      EXPECT_LE(narrow.lo[i], wide.lo[i]);
      EXPECT_GE(narrow.hi[i], wide.hi[i]);
      for (std::size_t k = i * points_per_box; k < (i + 1) * points_per_box; ++k) {
        EXPECT_LE(wide.lo[i], f[k] + slack[k]);
        EXPECT_GE(wide.hi[i], f[k] - slack[k]);
      }
      if (HasFailure()) break;
    }
  }
}

}  // namespace
}  // namespace imp
