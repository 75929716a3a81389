// The text form goes both ways, and reads well.
#include "ir/text.h"

#include <gtest/gtest.h>

#include "ir/loop.h"
#include "tests/support/golden.h"
#include "tests/support/make.h"
#include "tests/support/random_program.h"

namespace imp {
namespace {

using test::input;
using test::number;
using test::output;
using test::random_program;

Program parsed(const std::string& text) {
  Diagnostics diagnostics;
  auto program = parse_program(text, "test.ir", diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << to_text(diagnostics) << text;
  return program.value_or(Program{});
}

bool goes_both_ways(const Program& p) {
  Diagnostics diagnostics;
  const std::string text = to_text(p);
  const auto back = parse_program(text, "test.ir", diagnostics);
  return back && *back == p && to_text(*back) == text;
}

// Shrinks what fails, so that it can be read.
void expect_both_ways(const Program& p, std::uint64_t seed) {
  if (goes_both_ways(p)) return;
  const Program small = test::shrink(p, [](const Program& q) { return !goes_both_ways(q); });
  Diagnostics diagnostics;
  const auto back = parse_program(to_text(small), "test.ir", diagnostics);
  ADD_FAILURE() << "seed " << seed << '\n'
                << to_text(diagnostics) << to_text(small) << "\nand back\n"
                << (back ? to_text(*back) : "");
}

TEST(Text, random_programs_go_both_ways) {
  for (std::uint64_t seed = 0; seed < 1500; ++seed)
    expect_both_ways(random_program(seed, {.nodes = 3 + seed % 50,
                                           .phases = seed % 4,
                                           .upward = seed % 2 == 0,
                                           .elementary = true,
                                           .tables = seed % 3 != 0,
                                           .calls = seed % 5 == 0,
                                           .packets = true,
                                           .odd_names = seed % 2 == 1}),
                     seed);
}

// A sphere, marched along a ray: what `imp inspect` shows.
Program march() {
  Program p;
  p.name = "march";
  const Expr r = input(p, "r", f32, Rate::frame);
  const Expr x = input(p, "x"), y = input(p, "y"), dx = input(p, "dx");
  const Expr rr = r * r;
  p.graph.set_name(rr.id, "rr");
  const Expr yy = y * y;
  Loop loop(p, "sphere_trace", 64);
  const Expr t = loop.state("t", number(p, 0)), found = loop.state("found", number(p, 0));
  const Expr px = x + t * dx;
  p.graph.set_name(px.id, "px");
  const Expr d = px * px + yy - rr;
  p.graph.set_name(d.id, "d");
  const Truth near = d <= 1e-4;
  p.graph.set_name(near.id, "near");
  loop.next(t, select(near, t, t + d));
  loop.next(found, select(near, one(found), found));
  loop.enter_if(yy < rr);
  loop.again_while(!near && t < 100.0);
  const Truth hit = loop.result(found) > 0.5;
  output(p, "t", loop.result(t));
  output(p, "hit", hit);
  return p;
}

Program shade() {
  Program p;
  p.name = "shade";
  p.callees.push_back(std::make_shared<Program>(march()));
  const Id depths = add_input(p, "depths", table_of(f32, 16), Rate::cell);
  const Expr slab = input(p, "slab"), r = input(p, "r", f32, Rate::frame),
             bias = input(p, "bias", f64, Rate::frame);
  const Expr start{&p.graph, p.graph.add(Op::load, {depths, slab.id})};
  p.graph.set_name(start.id, "start");
  const std::array args{r.id, start.id, slab.id, r.id};
  const Expr t{&p.graph, p.graph.call(f32, 0, 0, args)};
  const Truth hit{&p.graph, p.graph.call(truth, 0, 1, args)};
  Loop loop(p, "collect", 16);
  const Expr kept = loop.state("kept", Expr{&p.graph, p.graph.fill(table_of(f32, 4), t.id)});
  const Expr depth = loop.state("depth", number(p, 0));
  loop.next(kept, make(Op::store, kept, depth, make(Op::load, Expr{&p.graph, depths}, depth)));
  loop.next(depth, depth + 1.0);
  loop.again_while(any(hit));
  output(p, "kept", widen(make(Op::load, loop.result(kept), number(p, 2))) + bias * 0.1);
  return p;
}

TEST(Text, of_a_search_reads_like_this) {
  test::expect_golden("march.ir", to_text(march()));
  expect_both_ways(march(), 0);
}

TEST(Text, of_a_program_that_calls_reads_like_this) {
  test::expect_golden("shade.ir", to_text(shade()));
  expect_both_ways(shade(), 0);
}

TEST(Text, of_a_pipeline_reads_like_this) {
  Program tiles;
  tiles.name = "tiles";
  const Expr column = input(tiles, "column"), slab = input(tiles, "slab");
  output(tiles, "depths", column + slab * 0.25);
  const Pipeline pipeline{{{4, 4, 16}, tiles}, {{16, 16, 1}, shade()}};
  const std::string text = to_text(pipeline);
  test::expect_golden("pipeline.ir", text);

  Diagnostics diagnostics;
  const auto back = parse_pipeline(text, "pipeline.ir", diagnostics);
  ASSERT_TRUE(back) << to_text(diagnostics);
  ASSERT_EQ(back->size(), 2u);
  EXPECT_EQ((*back)[0].cells, (std::array{4u, 4u, 16u}));
  EXPECT_TRUE((*back)[0].program == tiles);
  EXPECT_TRUE((*back)[1].program == shade());
  EXPECT_EQ(to_text(*back), text);
}

TEST(Text, the_example_of_the_header_can_be_read) {
  const Program p = parsed(R"(
    program march
      input frame r: f32
      input ray x: f32
      %1 = mul %x %x
      phase bisect 64
        state t: f32 = 0f
        %2 = add %t 1f
        %3 = lt %2 %1
        next t = %2
        enter true   # that is the default
        again %3
      end
      output t = %bisect.t
    end)");
  EXPECT_EQ(p.phases.at(0).steps, 64u);
  EXPECT_EQ(p.outputs.at(0).name, "t");
  expect_both_ways(p, 0);
}

TEST(Text, constants_are_the_shortest_text_that_reads_back) {
  Program p;
  const double infinity = INFINITY, nan = NAN;
  for (const double v : {0.1, -0.0, 1e300, 5e-324, 3.0, 1e16, -2.5, infinity, nan})
    output(p, "d" + std::to_string(p.outputs.size()), number(p, v, f64));
  for (const double v : {0.1, -0.0, 1e-45, 3.4028234663852886e38, 16777216.0, -infinity, nan})
    output(p, "f" + std::to_string(p.outputs.size()), number(p, v));
  output(p, "yes", truth_of(p.graph, true));
  EXPECT_EQ(to_text(p), R"(program ""

  output d0 = 0.1
  output d1 = -0
  output d2 = 1e+300
  output d3 = 5e-324
  output d4 = 3
  output d5 = 1e+16
  output d6 = -2.5
  output d7 = inf
  output d8 = nan
  output f9 = 0.1f
  output f10 = -0f
  output f11 = 1e-45f
  output f12 = 3.4028235e+38f
  output f13 = 16777216f
  output f14 = -inff
  output f15 = nanf
  output yes = true
end
)");
  expect_both_ways(p, 0);
}

TEST(Text, every_constant_comes_back_bit_for_bit) {
  test::Random random(5);
  for (int i = 0; i < 3000; ++i) {
    Program p;
    output(p, "d", number(p, std::bit_cast<double>(random.bits()), f64));
    output(p, "f", number(p, std::bit_cast<float>(static_cast<std::uint32_t>(random.bits()))));
    const Program q = parsed(to_text(p));
    ASSERT_EQ(q.outputs.size(), 2u);
    for (std::size_t k = 0; k < 2; ++k)
      EXPECT_EQ(q.graph[q.outputs[k].id].payload, p.graph[p.outputs[k].id].payload) << to_text(p);
  }
}

TEST(Text, names_are_quoted_where_they_are_no_words) {
  Program p;
  p.name = "a \"b\"";
  const Expr x = input(p, "x.y"), one = input(p, "1"), nan = input(p, "nan"), line = input(p, "\n\\");
  output(p, "f'", (x + one) * (nan - line));
  EXPECT_EQ(to_text(p), R"(program "a \"b\""
  input ray "x.y": f32
  input ray "1": f32
  input ray nan: f32
  input ray "\x0a\\": f32

  %1 = sub %nan %"\x0a\\"
  %2 = add %"x.y" %"1"
  %3 = mul %1 %2

  output "f'" = %3
end
)");
  expect_both_ways(p, 0);
}

TEST(Text, names_of_nodes_are_kept_and_made_unique) {
  Program p;
  const Expr x = input(p, "x");
  const Expr a = x * x, b = a + x, c = b / x, d = c - x;
  p.graph.set_name(a.id, "s");
  p.graph.set_name(b.id, "s");
  p.graph.set_name(c.id, "x");  // as the input
  output(p, "d", d);
  const std::string text = to_text(p);
  EXPECT_EQ(text, R"(program ""
  input ray x: f32

  %s = mul %x %x
  %s_2 = add %x %s
  %x_2 = div %s_2 %x
  %1 = sub %x_2 %x

  output d = %1
end
)");
  EXPECT_EQ(parsed(text).graph.name(parsed(text).graph[parsed(text).outputs[0].id].args[0]), "x_2");
  expect_both_ways(p, 0);
}

TEST(Text, a_state_called_like_an_input_is_written_in_full) {
  Program p;
  const Expr t = input(p, "t");
  Loop loop(p, "go", 3);
  const Expr state = loop.state("t", t);
  loop.next(state, state + t);
  output(p, "t", loop.result(state));
  EXPECT_EQ(to_text(p), R"(program ""
  input ray t: f32

  phase go 3
    state t: f32 = %t
    %1 = add %t %go.t
    next t = %1
    again true
  end

  output t = %go.t
end
)");
  expect_both_ways(p, 0);
}

TEST(Text, callees_of_one_name_are_told_apart) {
  const auto callee = [](double factor) {
    Program p;
    p.name = "scale";
    output(p, "y", input(p, "x") * factor);
    return std::make_shared<Program>(p);
  };
  Program p;
  p.name = "twice";
  p.callees = {callee(2), callee(3)};
  const Expr x = input(p, "x");
  const Expr a{&p.graph, p.graph.call(f32, 1, 0, std::array{x.id})};
  output(p, "y", Expr{&p.graph, p.graph.call(f32, 0, 0, std::array{a.id})});
  EXPECT_NE(to_text(p).find("  calls scale, scale@2\n"), std::string::npos) << to_text(p);
  EXPECT_NE(to_text(p).find("  %1 = call scale@2.y %x\n  %2 = call scale.y %1\n"), std::string::npos)
      << to_text(p);
  expect_both_ways(p, 0);
}

TEST(Text, a_callee_of_two_programs_is_printed_once) {
  auto inner = std::make_shared<Program>();
  inner->name = "inner";
  output(*inner, "y", input(*inner, "x") * 2.0);
  const auto outer = [&](std::string name) {
    auto p = std::make_shared<Program>();
    p->name = name;
    p->callees = {inner};
    const Expr x = input(*p, "x");
    output(*p, "y", Expr{&p->graph, p->graph.call(f32, 0, 0, std::array{x.id})});
    return p;
  };
  Program p;
  p.name = "top";
  p.callees = {outer("left"), outer("right"), inner};
  output(p, "y", number(p, 1));
  const std::string text = to_text(p);
  EXPECT_EQ(text.find("program inner"), text.rfind("program inner")) << text;
  expect_both_ways(p, 0);
}

TEST(Text, nodes_remember_where_they_were_written) {
  const std::string text = "program p\n  input ray x: f32\n  %y = mul %x 2f\n  output y = %y\nend\n";
  Diagnostics diagnostics;
  const auto p = parse_program(text, "p.ir", diagnostics);
  ASSERT_TRUE(p);
  const Span span = p->graph.span(p->outputs[0].id);
  ASSERT_TRUE(span.valid());
  EXPECT_EQ(text.substr(span.begin, span.end - span.begin), "%y = mul %x 2f");
}

TEST(Text, a_long_program_is_read_in_one_go) {
  Program p;
  const Expr x = input(p, "x"), y = input(p, "y");
  Expr z = x;
  for (int i = 0; i < 50000; ++i) z = z * x + y;
  output(p, "z", z);
  EXPECT_TRUE(goes_both_ways(p));
}

}  // namespace
}  // namespace imp
