// One bad Program for every rule.
#include "ir/verify.h"

#include <gtest/gtest.h>

#include <functional>

#include "ir/loop.h"
#include "tests/support/make.h"
#include "tests/support/random_program.h"

namespace imp {
namespace {

using test::input;
using test::number;
using test::output;
using test::truth_input;

// Two phases, a table, a call: something to spoil for every rule.
struct Good {
  Program p;
  Expr x, d, a, b;
  Truth c;
  Id table, entry, called;

  Good() {
    p.name = "good";
    auto callee = std::make_shared<Program>();
    callee->name = "callee";
    output(*callee, "y", input(*callee, "x") * 2.0);
    p.callees.push_back(callee);
    x = input(p, "x");
    d = input(p, "d", f64);
    c = truth_input(p, "c");
    table = add_input(p, "table", table_of(f32, 4), Rate::cell);
    entry = p.graph.add(Op::load, {table, x.id});
    called = p.graph.call(f32, 0, 0, std::array{entry});
    Loop first(p, "first", 3);
    a = first.state("t", x);
    first.next(a, a + Expr{&p.graph, called});
    first.again_while(a < 5.0);
    Loop second(p, "second", 3);
    b = second.state("t", first.result(a));
    second.next(b, b * first.result(a));
    second.again_while(c);
    output(p, "t", second.result(b));
  }
  Phase& phase(std::size_t i) { return p.phases[i]; }
  State& state(std::size_t i) { return p.phases[i].states[0]; }
  Expr result(std::size_t i) { return {&p.graph, state(i).result}; }
};

struct Flaw {
  const char* wrong;
  std::function<void(Good&)> spoil;
};

class Verify : public testing::TestWithParam<Flaw> {};

TEST_P(Verify, names_what_is_wrong) {
  Good good;
  ASSERT_EQ(verify(good.p), "");
  GetParam().spoil(good);
  EXPECT_NE(verify(good.p).find(GetParam().wrong), std::string::npos) << "said: " << verify(good.p);
}

INSTANTIATE_TEST_SUITE_P(
    , Verify,
    testing::ValuesIn(std::vector<Flaw>{
        // names
        {"two inputs are called 'x'", [](Good& g) { g.p.inputs[1].name = "x"; }},
        {"two outputs are called 't'", [](Good& g) { output(g.p, "t", g.x); }},
        {"two phases are called 'first'", [](Good& g) { g.phase(1).name = "first"; }},
        {"two states are called 't'", [](Good& g) { g.phase(0).states.push_back(g.state(0)); }},
        {"an unnamed input", [](Good& g) { g.p.inputs[0].name = ""; }},
        {"an unnamed output", [](Good& g) { g.p.outputs[0].name = ""; }},
        {"an unnamed phase", [](Good& g) { g.phase(0).name = ""; }},
        {"an unnamed state", [](Good& g) { g.state(0).name = ""; }},
        // leaves
        {"no such input", [](Good& g) { g.p.graph.leaf(Op::input, f32, 9); }},
        {"no such input", [](Good& g) { g.p.graph.leaf(Op::input, f64, 0); }},
        {"the node of 'x' is not its input", [](Good& g) { g.p.inputs[0].type = f64; }},
        {"the node of 'x' is not its input", [](Good& g) { std::swap(g.p.inputs[0].id, g.p.inputs[1].id); }},
        {"'x' has no node", [](Good& g) { g.p.inputs[0].id = {}; }},
        {"no such phase", [](Good& g) { g.p.graph.leaf(Op::state, f32, pair_of(2, 0)); }},
        {"no such state", [](Good& g) { g.p.graph.leaf(Op::result, f32, pair_of(0, 1)); }},
        {"not that of state 't'", [](Good& g) { g.p.graph.leaf(Op::result, f64, pair_of(0, 0)); }},
        {"the node of 't' is not its state", [](Good& g) { g.state(0).type = f64; }},
        {"the node of 't' is not its result", [](Good& g) { g.state(0).result = g.state(0).id; }},
        // types
        {"is a table of rate ray", [](Good& g) { g.p.inputs[3].rate = Rate::ray; }},
        {"a table of truths", [](Good& g) { g.p.graph.fill(table_of(truth, 3), g.c.id); }},
        {"65536 is the most", [](Good& g) { g.p.graph.fill(table_of(f32, 65537), g.x.id); }},
        {"output 'table' is a table", [](Good& g) { g.p.outputs.push_back({"table", g.table}); }},
        {"output 'none' has no node", [](Good& g) { g.p.outputs.push_back({"none", Id{}}); }},
        {"the exponent of 'powi' is", [](Good& g) { g.p.graph.add(Op::powi, {g.x.id, g.x.id}); }},
        {"the exponent of 'powi' is", [](Good& g) { make(Op::powi, g.x, number(g.p, 0.5)); }},
        {"the exponent of 'powi' is", [](Good& g) { make(Op::powi, g.x, number(g.p, 1048577)); }},
        {"the degree of 'chebyshev' is",
         [](Good& g) { g.p.graph.add(Op::chebyshev, {g.x.id, g.x.id, g.x.id}); }},
        {"the degree of 'chebyshev' is",
         [](Good& g) { make(Op::chebyshev, g.x, number(g.p, -1), number(g.p, 0)); }},
        {"the degree of 'chebyshev' is",
         [](Good& g) { make(Op::chebyshev, g.x, number(g.p, 2.5), number(g.p, 0)); }},
        {"the order of 'chebyshev' is",
         [](Good& g) { make(Op::chebyshev, g.x, number(g.p, 3), number(g.p, 4)); }},
        {"the order of 'chebyshev' is",
         [](Good& g) { make(Op::chebyshev, g.x, number(g.p, 30), number(g.p, 9)); }},
        // calls
        {"no such callee", [](Good& g) { g.p.graph.call(f32, 1, 0, std::array{g.x.id}); }},
        {"'callee' has no such output", [](Good& g) { g.p.graph.call(f32, 0, 1, std::array{g.x.id}); }},
        {"not of the type of 'callee.y'", [](Good& g) { g.p.graph.call(f64, 0, 0, std::array{g.x.id}); }},
        {"'callee' takes 1 operands, not 2",
         [](Good& g) { g.p.graph.call(f32, 0, 0, std::array{g.x.id, g.x.id}); }},
        {"operand 'x' of 'callee' is f32, not f64",
         [](Good& g) { g.p.graph.call(f32, 0, 0, std::array{g.d.id}); }},
        {"callee 1 is missing", [](Good& g) { g.p.callees.push_back(nullptr); }},
        {"callee 'callee' is listed twice", [](Good& g) { g.p.callees.push_back(g.p.callees[0]); }},
        {"in callee 'bad': two outputs are called 'a'",
         [](Good& g) {
           auto bad = std::make_shared<Program>();
           bad->name = "bad";
           output(*bad, "a", number(*bad, 1));
           output(*bad, "a", number(*bad, 2));
           g.p.callees.push_back(bad);
         }},
        // phases
        {"phase 'first' has no steps", [](Good& g) { g.phase(0).steps = 0; }},
        {"'enter' of phase 'first' has no node", [](Good& g) { g.phase(0).enter = {}; }},
        {"'enter' of phase 'first' is f32, not truth", [](Good& g) { g.phase(0).enter = g.x.id; }},
        {"'enter' of phase 'first' uses a state outside of its phase",
         [](Good& g) { g.phase(0).enter = (g.a < g.x).id; }},
        {"'enter' of phase 'first' uses the result of a phase before its end",
         [](Good& g) { g.phase(0).enter = (g.result(0) < g.x).id; }},
        {"'again' of phase 'first' is f64, not truth", [](Good& g) { g.phase(0).again = g.d.id; }},
        {"'again' of phase 'first' uses a state outside of its phase",
         [](Good& g) { g.phase(0).again = (g.b < g.x).id; }},
        {"'again' of phase 'first' uses the result of a phase before its end",
         [](Good& g) { g.phase(0).again = (g.result(0) < g.x).id; }},
        {"the start of 'first.t' is f64, not f32", [](Good& g) { g.state(0).init = g.d.id; }},
        {"the start of 'second.t' uses a state outside of its phase",
         [](Good& g) { g.state(1).init = g.b.id; }},
        {"the start of 'second.t' uses the result of a phase before its end",
         [](Good& g) { g.state(1).init = g.result(1).id; }},
        {"the next value of 'first.t' is f64, not f32", [](Good& g) { g.state(0).next = g.d.id; }},
        {"the next value of 'first.t' has no node", [](Good& g) { g.state(0).next = {}; }},
        {"the next value of 'second.t' uses a state outside of its phase",
         [](Good& g) { g.state(1).next = g.a.id; }},
        {"the next value of 'second.t' uses a state outside of its phase",
         [](Good& g) { g.state(1).next = (g.a + g.b).id; }},
        {"the next value of 'first.t' uses the result of a phase before its end",
         [](Good& g) { g.state(0).next = (g.a + g.result(0)).id; }},
        {"output 'a' uses a state outside of its phase", [](Good& g) { output(g.p, "a", g.a * 2.0); }},
    }));

TEST(VerifyGood, programs_have_nothing_wrong) {
  EXPECT_EQ(verify(Program{}), "");
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const Program p = test::random_program(seed, {.phases = seed % 4,
                                                  .upward = true,
                                                  .elementary = true,
                                                  .tables = true,
                                                  .calls = true,
                                                  .packets = true,
                                                  .odd_names = seed % 2 == 0});
    EXPECT_EQ(verify(p), "") << "seed " << seed;
  }
}

TEST(VerifyGood, dead_nodes_may_mix_phases) {
  Good good;
  good.a + good.b;
  EXPECT_EQ(verify(good.p), "");
}

TEST(VerifyGood, a_long_program_takes_no_recursion) {
  Program p;
  const Expr x = input(p, "x");
  Expr z = x;
  for (int i = 0; i < 200000; ++i) z = z * x + 0.5;
  output(p, "z", z);
  EXPECT_EQ(verify(p), "");
}

TEST(Shrink, leaves_what_matters) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Program p = test::random_program(seed, {.nodes = 60, .phases = 2, .tables = true, .calls = true});
    const auto has_floor = [](const Program& q) {
      const Program r = compact(q);
      for (std::uint32_t i = 0; i < r.graph.size(); ++i)
        if (r.graph[Id{i}].op == Op::floor) return true;
      return false;
    };
    if (!has_floor(p)) continue;
    const Program small = test::shrink(p, has_floor);
    EXPECT_TRUE(has_floor(small));
    EXPECT_LE(small.graph.size(), small.inputs.size() + 10);
    EXPECT_EQ(verify(small), "");
  }
}

}  // namespace
}  // namespace imp
