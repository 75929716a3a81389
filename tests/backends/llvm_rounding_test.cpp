// Upward ops are never below the exact value, whatever LLVM knows about signs; and the floating-point mode
// of the caller neither matters nor changes.
#include <xmmintrin.h>

#include <random>

#include "ir/expr.h"
#include "ir/rounding.h"
#include "tests/backends/llvm_support.h"

namespace imp {
namespace {

// Expressions that an optimiser which thinks of round-to-nearest would rewrite: each with its value as
// the host computes it rounding upward.
Program tempting(Type type) {
  Program program;
  program.name = "tempting";
  Graph& graph = program.graph;
  const auto input = [&](const char* name) {
    return Expr{&graph, add_input(program, name, type, Rate::ray)};
  };
  const Expr a = input("a"), b = input("b"), c = input("c");
  const Expr third = one(a) / constant_like(a, 3);
  const std::pair<const char*, Expr> outputs[] = {
      {"product", mul_up(a, b)},
      {"product_down", -mul_up(-a, b)},
      {"sum", add_up(a, b)},
      {"sum_down", -add_up(-a, -b)},
      {"quotient", div_up(a, b)},
      {"quotient_down", -div_up(-a, b)},
      {"root", sqrt_up(abs(a))},
      {"width", add_up(mul_up(a, b), mul_up(-a, b))},
      {"scaled_down", -mul_up(-a, constant_like(a, 0.4))},
      {"fused", fma_up(a, b, c)},
      {"fused_down", -fma_up(-a, b, -c)},
      {"fused_other", -fma_up(a, b, c)},
      {"fused_minus", fma_up(-a, b, c)},
      {"plain_product_down", -((-a) * b)},
      {"plain_width", a * b + (-a) * b},
      {"plain_difference", (a - b) + (b - a)},
      {"third", third},
      {"third_down", -((-one(a)) / constant_like(a, 3))},
      {"thirds", third + mul_up(zero(a), a)},
      {"square_down", -((-a) * a)},
  };
  for (const auto& [name, value] : outputs) program.outputs.push_back({name, value.id});
  return program;
}

struct Operands {
  Column a, b, c;
};

Operands random_operands(Type type) {
  std::mt19937_64 random(20240611);
  std::uniform_real_distribution<double> mantissa(-2, 2);
  std::uniform_int_distribution<int> exponent(-12, 12);
  const auto number = [&] {
    const double value = std::ldexp(mantissa(random), exponent(random));
    return type == f32 ? static_cast<float>(value) : value;
  };
  Operands operands;
  for (int i = 0; i < 10000; ++i)
    for (Column* column : {&operands.a, &operands.b, &operands.c}) column->push_back(number());
  return operands;
}

const Column& output(const Program& program, const std::vector<Column>& columns, std::string_view name) {
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (program.outputs[i].name == name) return columns[i];
  ADD_FAILURE() << name;
  return columns[0];
}

TEST(LlvmRounding, is_upward_where_an_optimiser_is_tempted) {
  for (const Type type : {f32, f64}) {
    const Program program = tempting(type);
    const auto [a, b, c] = random_operands(type);
    const auto reference = interpret(program);
    const auto expected = run(*reference, {a, b, c}, a.size());
    for (const CpuTarget& target : targets_here()) {
      const auto got = run(*compiled(program, target), {a, b, c}, a.size());
      const bool fuses = target.register_bits > 128;
      for (std::size_t i = 0; i < got.size(); ++i) {
        const std::string& name = program.outputs[i].name;
        if (name.starts_with("fused") && !fuses) continue;
        for (std::size_t row = 0; row < a.size(); ++row)
          ASSERT_TRUE(same(got[i][row], expected[i][row]))
              << target.name << " " << to_text(type) << " " << name << ": a=" << a[row] << " b=" << b[row];
      }
    }
  }
}

// f32 against exact values in f64 and long double, so that the interpreter need not be believed.
TEST(LlvmRounding, is_never_below_the_exact_value) {
  const Program program = tempting(f32);
  const auto [a, b, c] = random_operands(f32);
  for (const CpuTarget& target : targets_here()) {
    const auto columns = run(*compiled(program, target), {a, b, c}, a.size());
    const auto at = [&](std::string_view name, std::size_t row) {
      return output(program, columns, name)[row];
    };
    int inexact = 0;
    for (std::size_t row = 0; row < a.size(); ++row) {
      const double x = a[row], y = b[row], product = x * y;  // exact: 24 + 24 bits
      const long double sum = static_cast<long double>(x) + y;
      const long double fused = static_cast<long double>(product) + c[row];
      ASSERT_GE(at("product", row), product);
      ASSERT_LE(at("product_down", row), product);
      ASSERT_LE(at("plain_product_down", row), product);
      ASSERT_LE(at("square_down", row), x * x);
      ASSERT_GE(at("sum", row), sum);
      ASSERT_LE(at("sum_down", row), sum);
      ASSERT_GE(at("fused", row), fused);
      ASSERT_LE(at("fused_down", row), fused);
      ASSERT_GE(at("quotient", row) * y * (y < 0 ? -1 : 1), x * (y < 0 ? -1 : 1));
      ASSERT_LE(at("quotient_down", row) * y * (y < 0 ? -1 : 1), x * (y < 0 ? -1 : 1));
      ASSERT_GE(at("root", row) * at("root", row), std::abs(x));
      const bool rounds = product != static_cast<float>(product);
      inexact += rounds ? 1 : 0;
      if (!rounds) continue;
      ASSERT_GT(at("width", row), 0);
      ASSERT_GT(at("plain_width", row), 0);
    }
    EXPECT_GT(inexact, 9000);
    EXPECT_GT(at("third", 0), 1.0 / 3);
    EXPECT_GT(at("thirds", 0), 1.0 / 3);
    EXPECT_LT(at("third_down", 0), 1.0 / 3);
  }
}

// Before the rays, in a callee and in a phase it is upward as well.
TEST(LlvmRounding, is_upward_everywhere) {
  const Program program = parsed(R"(
program inner
  input ray x: f32
  %t = div 1f %x
  output t = %t
end

program outer
  calls inner
  input frame k: f32
  input ray x: f32
  %a = div 1f %k
  %b = call inner.t %x
  %zero = mul_up %x 0f
  phase p 1
    state t: f32 = 0f
    %u = div 1f %x
    next t = %u
    again false
  end
  output a = %a
  output b = %b
  output c = %p.t
  output zero = %zero
end)");
  for (const CpuTarget& target : targets_here())
    for (const Column& column : run(*compiled(program, target), {{3}, {3, 3}}, 2)) {
      if (column[0] == 0) continue;
      EXPECT_GT(column[0], 1.0 / 3);
      EXPECT_GT(column[1], 1.0 / 3);
    }
}

constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x0040, down = 0x2000;

TEST(LlvmRounding, the_mode_of_the_caller_neither_matters_nor_changes) {
  const Program up = tempting(f32);
  const Program plain = parsed(R"(
program plain
  input ray a: f32
  input ray b: f32
  input ray c: f32
  %p = mul %a %b
  %q = mul %p 1e-40f
  %s = add %q %c
  %t = mul %s 1e-39f
  %d = div %a 3f
  output q = %q
  output t = %t
  output d = %d
end)");
  const auto [a, b, c] = random_operands(f32);
  const unsigned before = _mm_getcsr();
  for (const Program& program : {up, plain})
    for (const CpuTarget& target : targets_here()) {
      const auto kernel = compiled(program, target);
      const auto expected = run(*kernel, {a, b, c}, 1000);
      for (const unsigned mode : {flush_to_zero | denormals_are_zero, down, flush_to_zero | down}) {
        std::vector<std::vector<float>> in, out(program.outputs.size(), std::vector<float>(1000));
        for (const Column& column : {a, b, c}) in.emplace_back(column.begin(), column.begin() + 1000);
        const void* inputs[] = {in[0].data(), in[1].data(), in[2].data()};
        std::vector<void*> outputs;
        for (auto& column : out) outputs.push_back(column.data());
        const Batch batch{1000, inputs, outputs};
        _mm_setcsr((before & ~0x3fu) | mode);
        kernel->run(batch);
        const unsigned after = _mm_getcsr();
        _mm_setcsr(before);
        EXPECT_EQ(after, (before & ~0x3fu) | mode);
        std::vector<Column> got;
        for (const auto& column : out) got.emplace_back(column.begin(), column.end());
        expect_same(got, expected, target.name);
      }
    }
}

}  // namespace
}  // namespace imp
