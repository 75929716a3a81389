// Tables: in registers, shared by all rays, in scratch memory.
#include "ir/infinity.h"
#include "tests/backends/llvm_support.h"

namespace imp {
namespace {

Column indices() {
  Column values = ramp(-2, 0.37);
  values[3] = std::numeric_limits<double>::quiet_NaN();
  values[7] = infinity;
  values[20] = -infinity;
  values[21] = -0.5;
  values[22] = 1e30f;
  return values;
}

Program with_length(std::string text, std::size_t length) {
  for (std::size_t at; (at = text.find("LENGTH")) != std::string::npos;)
    text.replace(at, 6, std::to_string(length));
  return parsed(text);
}

constexpr std::size_t lengths[] = {1, 3, 4, 5, 9, 40};

Column first(Column values, std::size_t length) {
  values.resize(length);
  return values;
}

TEST(LlvmTables, given_ones_are_loaded) {
  for (const std::size_t length : lengths)
    expect_agreement(
        with_length(R"(
program lookup
  input frame a: f32[LENGTH]
  input cell b: f64[LENGTH]
  input frame at: f32
  input ray i: f32
  input ray j: f64
  %first = load %a 0f
  %last = load %a 1000f
  %no = load %a nanf
  %same = load %b %at
  %x = load %a %i
  %y = load %b %j
  %z = load %b %i
  output first = %first
  output last = %last
  output no = %no
  output same = %same
  output x = %x
  output y = %y
  output z = %z
end)",
                    length),
        {first(ramp(1, 0.5), length), first(ramp(-7, 0.3), length), {1.7}, indices(), indices()});
}

// A stack, pushed and popped, whose depth differs from ray to ray.
TEST(LlvmTables, a_stack) {
  for (const std::size_t length : lengths)
    expect_agreement(with_length(R"(
program stack
  input ray x: f32
  %empty = fill f32[LENGTH] 0f
  phase push 25
    state depth: f32 = 0f
    state stack: f32[LENGTH] = %empty
    %value = mul %depth %x
    %pushed = store %stack %depth %value
    %deeper = add %depth 1f
    %more = lt %deeper %x
    next depth = %deeper
    next stack = %pushed
    again %more
  end
  phase pop 25
    state depth: f32 = %push.depth
    state sum: f32 = 0f
    state rest: f32[LENGTH] = %push.stack
    %up = sub %depth 1f
    %top = load %rest %up
    %weighted = mul %top %depth
    %total = add %sum %weighted
    %again = lt 0f %up
    %gone = store %rest %up -1f
    next depth = %up
    next sum = %total
    next rest = %gone
    again %again
  end
  %a = load %push.stack 2f
  %b = load %pop.rest 2f
  %c = load %pop.rest %x
  output sum = %pop.sum
  output a = %a
  output b = %b
  output c = %c
end)",
                                 length),
                     {ramp(-3, 0.6)});
}

// A load looks through the stores before it, and not through those after it.
TEST(LlvmTables, are_values) {
  for (const std::size_t length : lengths)
    expect_agreement(with_length(R"(
program values
  input frame given: f64[LENGTH]
  input frame k: f64
  input ray x: f64
  input ray y: f64
  %one = store %given %x 10
  %two = store %one %y %x
  %three = store %two 1 -3
  %four = store %three %k 4
  %a = load %given %y
  %b = load %one %y
  %c = load %two %x
  %d = load %three 1
  %e = load %four %y
  %f = load %four 0
  phase p 6
    state t: f64[LENGTH] = %four
    state u: f64[LENGTH] = %given
    state i: f64 = %x
    %old = load %t %i
    %changed = store %t %y %old
    %more = store %changed %i 7
    %new = load %more %y
    %less = store %u 2 %new
    %j = add %i 1
    %yes = lt %j %y
    next t = %more
    next u = %less
    next i = %j
    again %yes
  end
  %g = load %p.t %x
  %h = load %p.u 2
  output a = %a
  output b = %b
  output c = %c
  output d = %d
  output e = %e
  output f = %f
  output g = %g
  output h = %h
end)",
                                 length),
                     {first(ramp(100, 1), length), {2}, indices(), ramp(3, -0.4)});
}

// Tables that become one another, or start anew in a step.
TEST(LlvmTables, swap) {
  for (const std::size_t length : lengths)
    expect_agreement(with_length(R"(
program swap
  input frame given: f32[LENGTH]
  input ray x: f32
  %zeros = fill f32[LENGTH] %x
  phase p 9
    state a: f32[LENGTH] = %given
    state b: f32[LENGTH] = %zeros
    state c: f32[LENGTH] = %zeros
    state n: f32 = 0f
    %m = add %n 1f
    %b2 = store %b %n 5f
    %fresh = fill f32[LENGTH] %m
    %c2 = store %fresh %x %n
    %more = lt %m %x
    next a = %b2
    next b = %a
    next c = %c2
    next n = %m
    again %more
  end
  %i = load %p.a %x
  %j = load %p.b %x
  %k = load %p.c %x
  %l = load %p.c 1f
  output i = %i
  output j = %j
  output k = %k
  output l = %l
end)",
                                 length),
                     {first(ramp(100, 1), length), indices()});
}

// Constant indices only: de Casteljau's triangle of degree 5, in registers.
TEST(LlvmTables, de_casteljau) {
  std::string body;
  for (int level = 0; level < 5; ++level)
    for (int i = 0; i < 5 - level; ++i) {
      const auto name = [&](const char* what, int l, int k) {
        return std::string("%") + what + std::to_string(l) + "_" + std::to_string(k);
      };
      const std::string table = level == 0 && i == 0 ? "%b"
                                : i == 0             ? name("s", level - 1, 4 - level + 1)
                                                     : name("s", level, i - 1);
      body += "    " + name("l", level, i) + " = load " + table + " " + std::to_string(i) + "f\n";
      body += "    " + name("r", level, i) + " = load " + table + " " + std::to_string(i + 1) + "f\n";
      body +=
          "    " + name("d", level, i) + " = sub " + name("r", level, i) + " " + name("l", level, i) + "\n";
      body += "    " + name("m", level, i) + " = mul " + name("d", level, i) + " %t\n";
      body +=
          "    " + name("v", level, i) + " = add " + name("l", level, i) + " " + name("m", level, i) + "\n";
      body += "    " + name("s", level, i) + " = store " + table + " " + std::to_string(i) + "f " +
              name("v", level, i) + "\n";
    }
  const Program program = parsed(
      "program casteljau\n  input frame c: f32[6]\n  input ray t: f32\n  phase p 3\n"
      "    state b: f32[6] = %c\n    state n: f32 = 0f\n" +
      body +
      "    %m = add %n 1f\n    %more = lt %m %t\n    next b = %s4_0\n    next n = %m\n"
      "    again %more\n  end\n  %x = load %p.b 0f\n  %y = load %p.b 3f\n"
      "  output x = %x\n  output y = %y\nend\n");
  expect_agreement(program, {{1, -2, 3, 0.5, 7, -1}, ramp(-1, 0.1)});
  for (const CpuTarget& target : targets_here())
    EXPECT_EQ(emit(program, target, CodeForm::llvm_ir)->find("[6 x <"), std::string::npos)
        << "a table in memory";
}

}  // namespace
}  // namespace imp
