// The reference rounds as the Program asks, whatever the caller's mode was, and gives it back.
#include <gtest/gtest.h>

#include <cfenv>
#include <thread>

#include "ir/loop.h"
#include "tests/support/evaluate.h"
#include "tests/support/make.h"
#include "tests/support/random_program.h"
#include "tests/support/rays.h"

#ifdef __SSE2__
#include <immintrin.h>
#endif

namespace imp {
namespace {

using test::input;
using test::number;
using test::output;

constexpr int modes[] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};

// Sets the caller's mode for as long as it lives.
class Mode {
 public:
  explicit Mode(int mode) : before_(std::fegetround()) { std::fesetround(mode); }
  ~Mode() { std::fesetround(before_); }
  Mode(const Mode&) = delete;
  Mode& operator=(const Mode&) = delete;

 private:
  int before_;
};

Program third(bool up) {
  Program p;
  const Expr x = input(p, "x", f64);
  output(p, "plain", x / 3.0);
  output(p, "minus", -x / 3.0);
  if (up) output(p, "up", div_up(x, number(p, 3, f64)));
  return p;
}

TEST(InterpreterRounding, to_nearest_without_upward_ops_whatever_the_callers_mode) {
  const auto kernel = interpret(third(false));
  for (const int mode : modes) {
    const Mode caller(mode);
    const auto got = test::evaluate(*kernel, std::array{1.0});
    EXPECT_EQ(got[0], 0x1.5555555555555p-2);
    EXPECT_EQ(got[1], -0x1.5555555555555p-2);
    EXPECT_EQ(std::fegetround(), mode);
  }
}

TEST(InterpreterRounding, upward_throughout_with_one) {
  const auto kernel = interpret(third(true));
  for (const int mode : modes) {
    const Mode caller(mode);
    const auto got = test::evaluate(*kernel, std::array{1.0});
    EXPECT_EQ(got[0], 0x1.5555555555556p-2);
    EXPECT_EQ(got[1], -0x1.5555555555555p-2);
    EXPECT_EQ(got[2], 0x1.5555555555556p-2);
    EXPECT_EQ(std::fegetround(), mode);
  }
}

TEST(InterpreterRounding, an_upward_op_in_a_callee_counts) {
  Program p;
  p.callees = {std::make_shared<Program>(third(true))};
  const Expr x = input(p, "x", f64);
  output(p, "plain", x / 3.0);
  output(p, "called", Expr{&p.graph, p.graph.call(f64, 0, 0, std::array{x.id})});
  const auto got = test::evaluate(p, {1});
  EXPECT_EQ(got[0], 0x1.5555555555556p-2);
  EXPECT_EQ(got[1], 0x1.5555555555556p-2);
}

TEST(InterpreterRounding, upward_ops_are_never_below_the_exact_value) {
  Program p;
  const Expr a = input(p, "a"), b = input(p, "b");
  output(p, "add", add_up(a, b));
  output(p, "sub", -add_up(-a, b));  // down(a - b), which has no op
  output(p, "mul", mul_up(a, b));
  output(p, "div", div_up(a, b));
  output(p, "sqrt", sqrt_up(abs(a)));
  output(p, "fma", fma_up(a, b, a));
  const auto kernel = interpret(p);
  test::Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const float u = static_cast<float>(random.between(-9, 9)), v = static_cast<float>(random.between(0.1, 9));
    const double x = u, y = v;  // sums and products are exact in double, the others nearly so
    const auto got = test::evaluate(*kernel, std::array{x, y});
    EXPECT_GE(got[0], x + y);
    EXPECT_LE(got[1], x - y);
    EXPECT_GE(got[2], x * y);
    EXPECT_GE(got[3] * y - x, -std::abs(x) * 0x1p-50);
    EXPECT_GE(got[4] * got[4] - std::abs(x), -std::abs(x) * 0x1p-50);
    EXPECT_GE(got[5], std::fma(x, y, x) * (1 - (x > 0 ? 1 : -1) * 0x1p-50));
    EXPECT_LE(got[2], std::nextafter(static_cast<float>(x * y), INFINITY));
  }
}

#ifdef __SSE2__
TEST(InterpreterRounding, denormals_are_kept_and_the_callers_flush_mode_comes_back) {
  Program p;
  output(p, "f", input(p, "x") * 0.5);
  const auto kernel = interpret(p);
  constexpr unsigned flush = 0x8040;
  const unsigned before = _mm_getcsr();
  _mm_setcsr(before | flush);
  float out = 0;
  const float in = std::numeric_limits<float>::min();
  const void* const from[] = {&in};
  void* const to[] = {&out};
  kernel->run({1, from, to});
  const unsigned after = _mm_getcsr();
  _mm_setcsr(before);
  EXPECT_EQ(after & flush, flush);
  EXPECT_EQ(out, std::numeric_limits<float>::min() / 2);
}
#endif

TEST(InterpreterRounding, the_callers_exception_flags_stay) {
  const auto kernel = interpret(third(false));
  std::feclearexcept(FE_ALL_EXCEPT);
  test::evaluate(*kernel, std::array{1.0});
  EXPECT_EQ(std::fetestexcept(FE_INEXACT), 0);
}

TEST(InterpreterRounding, the_trace_is_told_rounding_to_nearest) {
  Program p = third(true);
  Loop loop(p, "go", 2);
  const Expr t = loop.state("t", number(p, 0));
  loop.next(t, t + 0.1);
  output(p, "t", loop.result(t));
  std::vector<int> seen;
  const auto kernel = interpret(p, [&](const TraceStep&) { seen.push_back(std::fegetround()); });
  const auto got = test::evaluate(*kernel, std::array{1.0});
  EXPECT_EQ(seen, (std::vector{FE_TONEAREST, FE_TONEAREST, FE_TONEAREST}));
  EXPECT_EQ(got[2], 0x1.5555555555556p-2) << "and the run goes on upward";
  EXPECT_EQ(got[0], 0x1.5555555555556p-2);
}

TEST(InterpreterRounding, is_safe_from_many_threads) {
  const Program p =
      test::random_program(11, {.nodes = 60, .phases = 2, .upward = true, .tables = true, .calls = true});
  const auto kernel = interpret(p);
  const auto run = [&](test::Rays& rays) {
    for (std::size_t i = 0; i < p.inputs.size(); ++i) rays.fill(i, 1.5);
    rays.run(*kernel);
  };
  test::Rays expected(p, 50);
  run(expected);
  std::vector<test::Rays> all(4, test::Rays(p, 50));
  {
    std::vector<std::jthread> threads;
    for (test::Rays& rays : all) threads.emplace_back([&] { run(rays); });
  }
  for (const test::Rays& rays : all)
    for (std::size_t i = 0; i < p.outputs.size(); ++i) EXPECT_EQ(rays.raw(i), expected.raw(i));
}

}  // namespace
}  // namespace imp
