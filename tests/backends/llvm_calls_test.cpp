// Calls: another Program under the active mask, with phases of its own.
#include "tests/backends/llvm_support.h"

namespace imp {
namespace {

constexpr const char* root = R"(
program root
  input frame eps: f32
  input ray x: f32
  input ray go: truth
  phase newton 40
    enter %go
    state t: f32 = 1f
    state steps: f32 = 0f
    %q = div %x %t
    %s = add %t %q
    %h = mul %s 0.5f
    %d = sub %h %t
    %size = abs %d
    %more = lt %eps %size
    %n = add %steps 1f
    next t = %h
    next steps = %n
    again %more
  end
  %many = lt 6f %newton.steps
  output t = %newton.t
  output steps = %newton.steps
  output many = %many
end
)";

TEST(LlvmCalls, in_every_region) {
  const Program program = parsed(std::string(root) + R"(
program caller
  calls root
  input frame e: f32
  input cell k: f32
  input ray x: f32
  %yes = lt %x 9f
  %one = call root.t %e %k true
  %onesteps = call root.steps %e %k true
  %onemany = call root.many %e %k true
  %t = call root.t %e %x %yes
  %steps = call root.steps %e %x %yes
  %many = call root.many %e %x %yes
  %sum = add %one %t
  phase p 8
    enter %many
    state u: f32 = %sum
    state wide: f32 = %e
    %v = call root.t %wide %u %many
    %m = call root.many %wide %u %yes
    %w = mul %wide 1.5f
    %next = add %v %k
    %more = lt %v 3f
    %either = or %more %m
    next u = %next
    next wide = %w
    again %either
  end
  %after = call root.steps %p.u %p.wide %yes
  output one = %one
  output onesteps = %onesteps
  output onemany = %onemany
  output t = %t
  output steps = %steps
  output many = %many
  output u = %p.u
  output after = %after
end)");
  expect_agreement(program, {{1e-5f}, {7}, ramp(-3, 0.7)});
}

TEST(LlvmCalls, a_callee_calls_and_is_called_once_for_all_of_its_outputs) {
  const Program program = parsed(std::string(root) + R"(
program twice
  calls root
  input ray x: f32
  %t = call root.t 0.0001f %x true
  %n = call root.steps 0.0001f %x true
  %u = call root.t 0.0001f %t true
  output u = %u
  output n = %n
end

program caller
  calls twice
  input ray x: f32
  %u = call twice.u %x
  %n = call twice.n %x
  %z = add %u %n
  output z = %z
end)");
  expect_agreement(program, {ramp(0.1, 0.7)});
  const std::string text = *emit(program, *cpu_target("avx2"), CodeForm::llvm_ir);
  const auto count = [&](const std::string& what) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += what.size()) ++found;
    return found;
  };
  EXPECT_EQ(count("@twice("), 2u) << "its definition and one call\n" << text;
  EXPECT_EQ(count("@root("), 3u) << "its definition and two calls\n" << text;
}

TEST(LlvmCalls, with_tables) {
  for (const char* length : {"3", "17"}) {
    std::string text = R"(
program lookup
  input frame table: f32[LENGTH]
  input ray i: f32
  %j = add %i 1f
  %a = load %table %i
  %b = load %table %j
  %ten = store %table %j 10f
  %c = load %ten %i
  %sum = add %a %b
  %all = add %sum %c
  output all = %all
end

program caller
  calls lookup
  input frame given: f32[LENGTH]
  input ray x: f32
  %a = call lookup.all %given %x
  %mine = store %given %x 5f
  %b = call lookup.all %mine %x
  phase p 4
    state t: f32[LENGTH] = %mine
    state s: f32 = 0f
    %v = call lookup.all %t %s
    %t2 = store %t %s %v
    %s2 = add %s 1f
    %more = lt %s2 %x
    next t = %t2
    next s = %s2
    again %more
  end
  %c = call lookup.all %p.t %x
  output a = %a
  output b = %b
  output c = %c
end)";
    for (std::size_t at; (at = text.find("LENGTH")) != std::string::npos;) text.replace(at, 6, length);
    expect_agreement(parsed(text), {Column(std::stoul(length), 2.5), ramp(-2, 0.3)});
  }
}

// A callee hears only the rays for which it is called.
TEST(LlvmCalls, any_in_a_callee) {
  const Program program = parsed(R"(
program ask
  input ray c: truth
  %any = any %c
  %all = all %c
  %a = select %any 1f 0f
  %b = select %all 2f 0f
  %sum = add %a %b
  output sum = %sum
end

program caller
  calls ask
  input ray x: f32
  %few = lt %x 3f
  phase p 1
    enter %few
    state s: f32 = -1f
    %y = add %x %s
    %big = lt 1f %y
    %sum = call ask.sum %big
    next s = %sum
    again false
  end
  output s = %p.s
end)");
  for (const CpuTarget& target : targets_here()) {
    const auto kernel = compiled(program, target);
    EXPECT_EQ(run(*kernel, {{0, 1, 5, 9}}, 4)[0], (Column{0, 0, -1, -1}));
    EXPECT_EQ(run(*kernel, {{0, 2.5, 5, 9}}, 4)[0], (Column{1, 1, -1, -1}));
    EXPECT_EQ(run(*kernel, {{2.1, 2.5, 1, 9}}, 2)[0], (Column{3, 3}));
  }
}

}  // namespace
}  // namespace imp
