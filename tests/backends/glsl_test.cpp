// Shaders: their text, what is refused, and that they leave the process as it was.
#include <cfenv>
#include <thread>

#include "backends/glsl/emit.h"
#include "ir/loop.h"
#include "tests/backends/llvm_support.h"
#include "tests/support/evaluate.h"
#include "tests/support/golden.h"
#include "tests/support/make.h"
#include "tests/support/shader.h"

namespace imp {
namespace {

// x^(2^5) by a phase, and its square root in double.
Program example() {
  Program square;
  square.name = "square";
  const Expr a = test::input(square, "a");
  test::output(square, "squared", a * a);

  Program program;
  program.name = "power";
  program.callees.push_back(std::make_shared<const Program>(std::move(square)));
  const Expr scale = test::input(program, "scale", f32, Rate::frame);
  const Id weights = add_input(program, "weights", table_of(f32, 3), Rate::cell);
  const Expr x = test::input(program, "x");
  Graph& graph = program.graph;
  const Expr start = x * scale;
  graph.set_name(start.id, "start");
  Loop loop(program, "squares", 5);
  const Expr p = loop.state("p", start), n = loop.state("n", constant_like(x, 0));
  loop.next(p, {&graph, graph.call(f32, 0, 0, std::array{p.id})});
  loop.next(n, n + 1.0);
  loop.again_while(p < 1e6);
  const Expr last = loop.result(p);
  test::output(program, "root", sqrt(widen(last)));
  test::output(program, "bound", add_up(last, {&graph, graph.add(Op::load, {weights, loop.result(n).id})}));
  test::output(program, "steps", loop.result(n));
  test::output(program, "large", last > 1e6);
  return program;
}

TEST(GlslGolden, a_program_as_text) {
  const auto text = emit_glsl(example());
  ASSERT_TRUE(text) << text.error().message;
  test::expect_golden("power.glsl", *text);
}

TEST(Glsl, computes_the_example) {
  IMP_NEEDS_GL();
  const auto kernel = test::shader_of(example());
  const auto got = run(*kernel, {{2}, {0, 10, 20}, {0.5, 1, 20}}, 3);
  EXPECT_EQ(got[0][0], 1);
  EXPECT_EQ(got[0][1], 65536);
  EXPECT_EQ(got[2], (Column{5, 5, 3}));
  EXPECT_EQ(got[3], (Column{0, 1, 1}));
  EXPECT_GT(got[1][0], 21);
  EXPECT_LT(got[1][0], 21.00001);
}

Program one_more() {
  Program program;
  test::output(program, "y", test::input(program, "x") + 1.0);
  return program;
}

TEST(Glsl, batches_of_any_size) {
  IMP_NEEDS_GL();
  const auto kernel = test::shader_of(one_more());
  for (const std::size_t size : {0u, 1u, 63u, 64u, 65u, 5'000'003u}) {
    std::vector<float> x(size), y(size);
    for (std::size_t i = 0; i < size; ++i) x[i] = static_cast<float>(i);
    const void* const in[] = {x.data()};
    void* const out[] = {y.data()};
    kernel->run({size, in, out});
    for (std::size_t i = 0; i < size; ++i) ASSERT_EQ(y[i], x[i] + 1) << size;
    void* const nothing[] = {nullptr};
    kernel->run({size, in, nothing});
  }
}

TEST(Glsl, runs_beside_machine_code_and_in_many_threads) {
  IMP_NEEDS_GL();
  const Program program = one_more();
  const auto expect = [](const Kernel& kernel) {
    for (int i = 0; i < 20; ++i)
      EXPECT_EQ(test::evaluate(kernel, std::array{static_cast<double>(i)})[0], i + 1);
  };
  const CpuTarget target = targets_here().front();
  expect(*compiled(program, target));
  expect(*test::shader_of(program));
  expect(*compiled(program, target));
  std::vector<std::jthread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back(
        [&, i] { expect(i % 2 == 0 ? *test::shader_of(program) : *compiled(program, target)); });
}

// 1 + x is 1 to nearest and above it upward.
TEST(Glsl, keeps_the_rounding_mode_and_does_not_heed_it) {
  IMP_NEEDS_GL();
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    const auto kernel = test::shader_of(one_more());
    const double value = test::evaluate(*kernel, {std::array{0x1p-30}})[0];
    const int after = std::fegetround();
    std::fesetround(FE_TONEAREST);
    EXPECT_EQ(after, mode);
    EXPECT_EQ(value, 1);
  }
}

std::string refusal_of(const Program& program) {
  const auto text = emit_glsl(program);
  return text ? "" : text.error().message;
}

TEST(Glsl, refuses_what_would_take_too_long_or_not_end) {
  Program large;
  Expr x = test::input(large, "x");
  for (int i = 0; i < 8000; ++i) x = x * x + 1.0;
  test::output(large, "f", x);
  EXPECT_EQ(refusal_of(large),
            "this takes 16000 operations, and a shader has at most 15000; use --backend=llvm");

  Program upward;
  Expr y = test::input(upward, "y");
  for (int i = 0; i < 1400; ++i) y = mul_up(y, y);
  test::output(upward, "f", y);
  EXPECT_EQ(refusal_of(upward),
            "this takes 15400 operations, and a shader has at most 15000; use --backend=llvm");

  Program slow;
  Loop loop(slow, "wait", 100'000);
  const Expr n = loop.state("n", test::input(slow, "n"));
  loop.next(n, n + 1.0);
  test::output(slow, "n", loop.result(n));
  EXPECT_EQ(refusal_of(slow),
            "this takes up to 100000 steps, and a shader makes at most 65535; use --backend=llvm");

  Program power;
  const Expr a = test::input(power, "a");
  power.outputs.push_back({"f", power.graph.add(Op::powi, {a.id, power.graph.constant(f32, 3)})});
  EXPECT_EQ(refusal_of(power), "'powi' has no shader form: the power pass must expand it first");
}

TEST(Glsl, names_that_it_does_not_allow) {
  Program program;
  for (const char* name :
       {"float", "vec3", "gl_Position", "a__b", "a b", "3", "ray", "zero", "sqrt", "é", "a_b", "\n}"})
    test::input(program, name);
  const auto inputs = program.inputs;
  Expr sum{&program.graph, inputs[0].id};
  for (std::size_t i = 1; i < inputs.size(); ++i) sum = sum + Expr{&program.graph, inputs[i].id};
  program.graph.set_name(sum.id, "double");
  test::output(program, "uniform \\\n", sqrt(sum));
  const auto text = emit_glsl(program);
  ASSERT_TRUE(text);
  IMP_NEEDS_GL();
  Column ones(inputs.size(), 3);
  EXPECT_EQ(test::evaluate(*test::shader_of(program), ones)[0], 6);
}

}  // namespace
}  // namespace imp
