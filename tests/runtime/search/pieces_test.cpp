// The stack of pieces: what was pushed last is on top, and where it is full nothing is lost.
#include "runtime/search/parts/pieces.h"

#include <gtest/gtest.h>

#include "passes/pass.h"
#include "tests/support/evaluate.h"
#include "tests/support/make.h"

namespace imp::test {
namespace {

// Piece i is [-i, -i + 0.5]: later ones lie nearer.
class Stack {
 public:
  explicit Stack(std::uint32_t capacity) {
    Program program{.name = "stack"};
    const Expr pushes = input(program, "pushes"), pops = input(program, "pops");
    Loop loop(program, "push_and_pop", 64);
    const Expr i = loop.state("i", zero(pushes));
    Pieces pieces(program, loop, pushes, capacity);
    const Truth push = i < pushes;
    pieces.next(push, !push, -i, 0.5 - i);
    const Expr next = i + 1.0;
    loop.next(i, next);
    const Expr any = loop.state("any", zero(i)), start = loop.state("start", zero(i));
    const Expr end = loop.state("end", zero(i));
    loop.next(any, select(pieces.any(), one(i), zero(i)));  // as it was before this step
    loop.next(start, pieces.start());
    loop.next(end, pieces.end());
    loop.again_while(i < pushes + pops);
    output(program, "any", loop.result(any));
    output(program, "start", loop.result(start));
    output(program, "end", loop.result(end));
    kernel_ = interpret(run_passes(std::move(program), kernel_passes()));
  }
  std::vector<double> after(int pushes, int pops) const {
    return evaluate(*kernel_, std::array{static_cast<double>(pushes), static_cast<double>(pops)});
  }

 private:
  std::unique_ptr<Kernel> kernel_;
};

TEST(Pieces, last_in_first_out_and_merged_where_there_is_no_room) {
  for (const int capacity : {1, 2, 3, 5, 12}) {
    const Stack stack(static_cast<std::uint32_t>(capacity));
    for (int pushes = 0; pushes <= 12; ++pushes)
      for (int pops = 0; pops <= std::min(pushes, capacity); ++pops) {
        const int left = std::min(pushes, capacity) - pops;
        const bool merged = left == capacity;  // the top, and all that there was no room for
        const auto expected = left == 0 ? std::vector<double>{0, 1, 1}
                                        : std::vector<double>{1, 1.0 - (merged ? pushes : left), 1.5 - left};
        EXPECT_EQ(stack.after(pushes, pops), expected) << capacity << ' ' << pushes << ' ' << pops;
      }
  }
}

}  // namespace
}  // namespace imp::test
