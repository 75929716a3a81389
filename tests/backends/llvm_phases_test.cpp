// Phases, masks and tails: what the interpreter says of each ray alone, packets say of all of them.
#include "tests/backends/llvm_support.h"

namespace imp {
namespace {

TEST(LlvmPhases, lanes_that_are_done_keep_their_state) {
  expect_agreement(parsed(R"(
program march
  input frame pace: f32
  input ray x: f32
  %step = mul %pace 0.25f
  phase march 100
    state t: f32 = 0f
    state n: f32 = 0f
    %next_t = add %t %step
    %next_n = add %n 1f
    %far = lt %next_t %x
    next t = %next_t
    next n = %next_n
    again %far
  end
  output t = %march.t
  output n = %march.n
end)"),
                   {{1.5}, ramp(-3, 0.7)});
}

TEST(LlvmPhases, stop_after_their_steps) {
  expect_agreement(parsed(R"(
program stop
  input ray x: f64
  phase p 3
    state t: f64 = %x
    %double = add %t %t
    next t = %double
    again true
  end
  output t = %p.t
end)"),
                   {ramp(-3, 0.7)});
}

TEST(LlvmPhases, some_rays_do_not_enter) {
  const Program program = parsed(R"(
program enter
  input ray x: f32
  input cell limit: f32
  %inside = lt %x %limit
  phase p 20
    enter %inside
    state t: f32 = %x
    state was: truth = false
    %next = add %t 1f
    %small = lt %next 9f
    %big = not %small
    next t = %next
    next was = %big
    again %small
  end
  %u = mul %p.t %p.t
  phase q 7
    enter %p.was
    state s: f32 = %u
    state k: truth = %p.was
    %half = mul %s 0.5f
    %more = lt 1f %half
    %keep = and %k %more
    next s = %half
    next k = %keep
    again %keep
  end
  output t = %p.t
  output s = %q.s
  output k = %q.k
end)");
  expect_agreement(program, {ramp(-3, 0.7), {6}});
  expect_agreement(program, {ramp(-3, 0.7), {-100}});  // none enters
}

TEST(LlvmPhases, states_change_at_once) {
  expect_agreement(parsed(R"(
program swap
  input ray x: f32
  phase p 31
    state a: f32 = %x
    state b: f32 = 1f
    state c: f32 = 2f
    %sum = add %a %b
    %more = lt %sum 100f
    next a = %b
    next b = %sum
    again %more
  end
  output a = %p.a
  output b = %p.b
  output c = %p.c
end)"),
                   {ramp(-3, 0.7)});
}

TEST(LlvmPhases, conversions_and_masks_of_both_widths) {
  expect_agreement(parsed(R"(
program widths
  input ray x: f32
  input ray y: f64
  input ray flag: truth
  %wide = widen %x
  %less = lt %wide %y
  %positive = lt 0f %x
  %c = and %less %positive
  %d = or %c %flag
  phase p 12
    enter %d
    state t: f32 = %x
    state s: f64 = %y
    state both: truth = %flag
    %t2 = mul %t 0.75f
    %s2 = add %s 0.3
    %n = narrow %s2
    %near = lt %n %t2
    %far = lt %s2 10
    %change = and %near %both
    %either = or %far %change
    %chosen = select %change %n %t2
    %wider = widen %chosen
    %other = select %near %wider %s2
    next t = %chosen
    next s = %other
    next both = %either
    again %either
  end
  output t = %p.t
  output s = %p.s
  output both = %p.both
  output d = %d
end)"),
                   {ramp(-3, 0.3), ramp(4, -0.2), ramp(-1, 0.5)});
}

TEST(LlvmPhases, same_for_all_rays) {
  expect_agreement(parsed(R"(
program uniform
  input frame a: f32
  input cell b: f32
  input frame flag: truth
  input ray x: f32
  %third = div 1f 3f
  %sum = add %a %third
  %product = mul %sum %b
  %c = lt %a %b
  %d = and %c %flag
  %e = select %d %product %x
  output sum = %sum
  output product = %product
  output d = %d
  output e = %e
  output constant = 3f
end)"),
                   {{0.1}, {7}, {1}, ramp(-3, 0.7)});
}

TEST(LlvmPhases, without_inputs) {
  expect_agreement(parsed(R"(
program none
  phase p 5
    state t: f32 = 1f
    %u = add %t %t
    next t = %u
    again true
  end
  output t = %p.t
end)"),
                   {});
}

TEST(LlvmPhases, an_output_may_be_left_out) {
  const Program program = parsed(R"(
program two
  input ray x: f32
  %a = add %x 1f
  output a = %a
  output x = %x
end)");
  const std::vector<float> x(40, 2);
  for (const CpuTarget& target : targets_here()) {
    const auto kernel = compiled(program, target);
    for (const std::size_t size : {1u, 16u, 37u}) {
      std::vector<float> a(40);
      const void* in[] = {x.data()};
      void* out[] = {a.data(), nullptr};
      kernel->run({size, in, out});
      for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i], i < size ? 3 : 0);
    }
  }
}

// The ray alone in its packet gets what it gets among others, whatever these are.
TEST(LlvmPhases, one_live_lane_gives_what_a_full_packet_gives) {
  const Program program = parsed(R"(
program newton
  input ray x: f32
  phase p 50
    state t: f32 = 1f
    %q = div %x %t
    %s = add %t %q
    %h = mul %s 0.5f
    %d = sub %h %t
    %size = abs %d
    %more = lt 1e-6f %size
    next t = %h
    again %more
  end
  output root = %p.t
end)");
  const Column values = ramp(0.1, 3.3);
  for (const CpuTarget& target : targets_here()) {
    const auto kernel = compiled(program, target);
    const Column together = run(*kernel, {values}, values.size())[0];
    for (std::size_t i = 0; i < values.size(); ++i)
      EXPECT_TRUE(same(run(*kernel, {{values[i]}}, 1)[0][0], together[i]));
  }
}

// In a phase `any` and `all` of what changes there hear the rays that are still active, and no others.
TEST(LlvmPhases, any_and_all_in_a_phase) {
  const Program program = parsed(R"(
program together
  input ray x: f32
  phase p 10
    state t: f32 = 0f
    state anys: f32 = 0f
    state alls: f32 = 0f
    %next = add %t 1f
    %more = lt %next %x
    %moved = add %x %t
    %odd = lt %moved 9.5f
    %a = any %odd
    %b = all %odd
    %one_a = select %a 1f 0f
    %one_b = select %b 1f 0f
    %sum_a = add %anys %one_a
    %sum_b = add %alls %one_b
    next t = %next
    next anys = %sum_a
    next alls = %sum_b
    again %more
  end
  output t = %p.t
  output anys = %p.anys
  output alls = %p.alls
end)");
  for (const CpuTarget& target : targets_here()) {
    const std::size_t lanes = target.lanes(program);
    for (std::size_t size = 1; size <= lanes; ++size) {
      Column x;
      for (std::size_t i = 0; i < size; ++i) x.push_back(static_cast<double>(i * 7 % 10));
      std::vector<Column> expected(3, Column(size));
      for (int step = 0; step < 10; ++step) {
        bool any = false, all = true;
        const auto active = [&](std::size_t i) { return step == 0 || step < x[i]; };
        for (std::size_t i = 0; i < size; ++i) {
          if (!active(i)) continue;
          any = any || x[i] + step < 9.5;
          all = all && x[i] + step < 9.5;
        }
        for (std::size_t i = 0; i < size; ++i) {
          if (!active(i)) continue;
          expected[0][i] += 1;
          expected[1][i] += any ? 1 : 0;
          expected[2][i] += all ? 1 : 0;
        }
      }
      expect_same(run(*compiled(program, target), {x}, size), expected,
                  target.name + ", " + std::to_string(size) + " rays");
    }
  }
}

}  // namespace
}  // namespace imp
