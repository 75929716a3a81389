// Enclosures of the catalogue's surfaces, in every form and on every target that runs here: no value
// lies outside of them, and none is called defined that is not (tools/dev prove surfaces tries more).
#include <gtest/gtest.h>

#include "tests/backends/llvm_support.h"
#include "tests/support/effort.h"
#include "tests/support/surface_trial.h"

namespace imp::test {
namespace {

struct Tried {
  std::string name;
  std::unique_ptr<Kernel> kernel;
};

void expect_no_value_outside(const TriedSurface& surface, const std::vector<Tried>& tried,
                             std::size_t boxes) {
  for (const Tried& each : tried) {
    const Kernel* const kernel = each.kernel.get();
    const SurfaceCount count = try_surface(surface, {&kernel, 1}, 1, boxes, 4);
    EXPECT_EQ(count.misses, 0u) << each.name << ": " << count.first;
    EXPECT_EQ(count.overclaimed, 0u) << each.name << ": " << count.first;
    EXPECT_LT(count.undecided * 10, count.values) << each.name;
  }
}

class InclusionOfSurface : public testing::TestWithParam<const SurfaceEntry*> {};

TEST_P(InclusionOfSurface, holds_every_value) {
  const TriedSurface surface(*GetParam());
  std::vector<Tried> tried;
  for (const Inclusion& form : inclusions())
    for (const Type type : {f32, f64}) {
      if (sanitized && type == f64) continue;
      if (auto kernel = surface.enclosure(form, type, {.backend = Backend::interpreter}))
        tried.push_back({std::string(form.name) + ", " + to_text(type), std::move(kernel)});
    }
  EXPECT_GE(tried.size(), 2u);
  expect_no_value_outside(surface, tried, effort(24));
}

INSTANTIATE_TEST_SUITE_P(Catalogue, InclusionOfSurface, testing::ValuesIn(all_entries()),
                         [](const auto& test) { return test.param->id; });

// A polynomial, a function with corners, and one of waves.
TEST(Inclusion, holds_every_value_on_every_target) {
  for (const char* id : {"tangle", "superquadric_knoll", "cloth"}) {
    const TriedSurface surface(entry_named(id));
    std::vector<Tried> tried;
    for (const Inclusion& form : inclusions())
      for (const Type type : {f32, f64}) {
        std::vector<KernelOptions> all;
        for (const CpuTarget& target : targets_here()) all.push_back({.target = target.name});
        if (type == f32 && form.name == "ia") all.push_back({.backend = Backend::glsl});
        for (const KernelOptions& options : all)
          if (auto kernel = surface.enclosure(form, type, options))
            tried.push_back({fmt::format("{}, {}, {}, {}", id, form.name, to_text(type),
                                         options.backend == Backend::glsl ? "glsl" : options.target),
                             std::move(kernel)});
      }
    EXPECT_GE(tried.size(), 4u);
    expect_no_value_outside(surface, tried, 40);
  }
}

// A float's enclosure holds that of doubles, and both backends mean the same.
TEST(Inclusion, in_float_holds_that_in_double) {
  const auto entries = algebraic_entries();
  for (const SurfaceEntry* entry : std::span(entries).first(effort(entries.size()))) {
    const TriedSurface surface(*entry);
    const auto boxes = boxes_in(entry->domain, 7, 40);
    const auto over = [&](Type type, Backend backend) {
      return surface.enclose(*surface.enclosure(inclusions().front(), type, {.backend = backend}), boxes);
    };
    const auto narrow = over(f32, Backend::llvm), same = over(f32, Backend::interpreter);
    const auto wide = over(f64, Backend::llvm);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      ASSERT_EQ(narrow.defined[i], 1) << entry->id;
      ASSERT_EQ(wide.defined[i], 1) << entry->id;
      ASSERT_EQ(narrow.lo[i], same.lo[i]) << entry->id;
      ASSERT_EQ(narrow.hi[i], same.hi[i]) << entry->id;
      ASSERT_LE(narrow.lo[i], wide.lo[i]) << entry->id;
      ASSERT_GE(narrow.hi[i], wide.hi[i]) << entry->id;
    }
  }
}

}  // namespace
}  // namespace imp::test
