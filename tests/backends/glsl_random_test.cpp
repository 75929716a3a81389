// Random Programs as shaders: phases, tables and calls, bit for bit as the interpreter has them.
#include "backends/glsl/emit.h"
#include "ir/text.h"
#include "passes/rewrite.h"
#include "runtime/kernel.h"
#include "tests/support/evaluate.h"
#include "tests/support/random_program.h"
#include "tests/support/rays.h"
#include "tests/support/shader.h"

namespace imp {
namespace {

// A fused op is two ops in a shader: written so, it means the same everywhere.
Program unfused(const Program& program) {
  Program result = rewrite(program, [](Graph& graph, Id, const Node& node) {
    if (node.op != Op::fma) return copy(graph, node);
    return graph.add(Op::add, {graph.add(Op::mul, {node.args[0], node.args[1]}), node.args[2]});
  });
  for (auto& callee : result.callees) callee = std::make_shared<const Program>(unfused(*callee));
  return result;
}

constexpr std::size_t ray_count = 70;  // more than a work group

test::Rays some_rays(const Program& program, std::uint64_t seed) {
  test::Random random(seed);
  test::Rays data(program, ray_count);
  for (std::size_t i = 0; i < program.inputs.size(); ++i) {
    const Input& input = program.inputs[i];
    const auto value = [&] {
      if (input.type.is_truth()) return random.one_in(2) ? 1.0 : 0.0;
      return random.one_in(4) ? test::special_values[random.below(std::size(test::special_values))]
                              : random.between(-4, 4);
    };
    for (std::size_t k = 0; k < (input.rate == Rate::ray ? ray_count : std::max(1u, input.type.length)); ++k)
      data.set(i, k, value());
  }
  return data;
}

std::string difference(const Program& program, std::uint64_t seed) {
  const auto shader = compile_glsl(program);
  if (!shader) return shader.error().message;
  test::Rays got = some_rays(program, seed), expected = got;
  got.run(**shader);
  expected.run(*interpret(program));
  for (std::size_t i = 0; i < program.outputs.size(); ++i)
    for (std::size_t ray = 0; ray < ray_count; ++ray)
      if (!test::same_bits(got.get(i, ray), expected.get(i, ray)))
        return "output " + std::to_string(i) + ", ray " + std::to_string(ray) + ": " +
               testing::PrintToString(got.get(i, ray)) + ", not " +
               testing::PrintToString(expected.get(i, ray));
  return "";
}

class GlslRandom : public testing::TestWithParam<std::uint64_t> {};

TEST_P(GlslRandom, programs_agree_with_the_interpreter) {
  IMP_NEEDS_GL();
  for (std::uint64_t seed = GetParam(); seed < GetParam() + 15; ++seed) {
    const test::RandomOptions options{.nodes = 40,
                                      .phases = seed % 3,
                                      .tables = seed % 2 == 0,
                                      .calls = seed % 3 != 1,
                                      .packets = true,
                                      .odd_names = seed % 5 == 0};
    const Program program = lower(unfused(test::random_program(seed, options)), {});
    const auto wrong = [&](const Program& p) { return !difference(p, seed).empty(); };
    if (!wrong(program)) continue;
    const Program small = test::shrink(program, wrong);
    FAIL() << "seed " << seed << ": " << difference(small, seed) << '\n'
           << to_text(small) << emit_glsl(small).value_or("");
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, GlslRandom, testing::Values(0, 15, 30, 45, 60, 75, 90, 105));

}  // namespace
}  // namespace imp
