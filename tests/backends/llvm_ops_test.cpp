// The ops that speak for a packet; of all others see agreement_test.cpp.
#include "tests/backends/llvm_support.h"

namespace imp {
namespace {

TEST(LlvmOps, any_and_all_speak_for_the_rays_of_a_packet) {
  Program program;
  program.name = "packet";
  const Id a = add_input(program, "a", truth, Rate::ray);
  program.outputs = {{"any", program.graph.add(Op::any, {a})}, {"all", program.graph.add(Op::all, {a})}};
  for (const CpuTarget& target : targets_here()) {
    const std::size_t lanes = target.lanes(program);
    const auto kernel = compiled(program, target);
    for (std::size_t size = 1; size <= 2 * lanes; ++size)
      for (const int density : {0, 1, 2, 3}) {
        Column values;
        for (std::size_t i = 0; i < size; ++i)
          values.push_back(density == 3 || (density != 0 && i % 5 == 3) || (density == 2 && i < lanes) ? 1
                                                                                                       : 0);
        std::vector<Column> expected(2);
        for (std::size_t i = 0; i < size; ++i) {
          const std::size_t first = i / lanes * lanes, last = std::min(first + lanes, size);
          const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first),
                     end = values.begin() + static_cast<std::ptrdiff_t>(last);
          expected[0].push_back(std::find(begin, end, 1) != end ? 1 : 0);
          expected[1].push_back(std::find(begin, end, 0) == end ? 1 : 0);
        }
        expect_same(run(*kernel, {values}, size), expected,
                    target.name + ", " + std::to_string(size) + " rays");
      }
  }
}

}  // namespace
}  // namespace imp
