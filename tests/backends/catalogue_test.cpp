// Every surface of the catalogue on every target: value, gradient and enclosure, bit for bit.
#include "tests/backends/llvm_support.h"
#include "tests/support/cast.h"

namespace imp {
namespace {

// The values' points, or small boxes around them; uniforms have their defaults.
std::vector<Column> columns(const Model& model, const test::SurfaceEntry& entry, Evaluation evaluation) {
  std::vector<Column> result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Column lo, hi;
    for (std::size_t i = 0; i < entry.values.size(); ++i) {
      lo.push_back(entry.values[i].p[axis]);
      hi.push_back(lo.back() + std::ldexp(1.0, -static_cast<int>(i)));
    }
    result.push_back(lo);
    if (over_boxes(evaluation)) result.push_back(hi);
  }
  Diagnostics diagnostics;
  const auto uniforms = uniform_values(model, {}, std::nullopt, diagnostics).value();
  for (const double value : uniforms) {
    result.push_back({value});
    if (over_boxes(evaluation)) result.push_back({value});
  }
  return result;
}

class Catalogue : public testing::TestWithParam<const test::SurfaceEntry*> {};

TEST_P(Catalogue, of_all_targets_with_the_interpreter) {
  const test::SurfaceEntry& entry = *GetParam();
  const Model model = test::model_of(entry);
  for (const Evaluation evaluation : {Evaluation::gradient, Evaluation::interval})
    for (const Type precision : {f32, f64}) {
      Diagnostics diagnostics;
      const auto program = evaluation_program(model.surfaces[0], evaluation, precision, diagnostics);
      ASSERT_TRUE(program) << to_text(diagnostics);
      const auto inputs = columns(model, entry, evaluation);
      const auto reference = test::kernel_of(*program, {.backend = Backend::interpreter});
      const auto expected = run_rows(*reference, inputs, entry.values.size());
      for (const CpuTarget& target : targets_here()) {
        const auto kernel = test::kernel_of(*program, {.target = target.name});
        expect_same(run_rows(*kernel, inputs, entry.values.size()), expected,
                    target.name + ", " + to_text(precision));
      }
    }
}

INSTANTIATE_TEST_SUITE_P(Surfaces, Catalogue, testing::ValuesIn(test::all_entries()),
                         [](const auto& test) { return test.param->id; });

// Code for a processor that this one need not be.
TEST(Avx512, uses_its_registers_and_no_library) {
  const Model model = test::model_of(test::entry_named("barth_sextic"));
  for (const Type precision : {f32, f64}) {
    Diagnostics diagnostics;
    const auto program =
        cast_program(model.surfaces[0], searches().front(), inclusions().front(), {}, precision, diagnostics);
    ASSERT_TRUE(program) << to_text(diagnostics);
    const auto assembly = emit(lower(*program, {}), cpu_target("avx512").value(), CodeForm::assembly);
    ASSERT_TRUE(assembly) << assembly.error().message;
    EXPECT_TRUE(assembly->contains("zmm"));
    for (std::size_t at = 0; (at = assembly->find("\tcall", at)) != std::string::npos; ++at) {
      const std::string line = assembly->substr(at, assembly->find('\n', at) - at);
      EXPECT_TRUE(line.contains("imp_barth_sextic")) << line;  // its own functions only
    }
  }
}

}  // namespace
}  // namespace imp
