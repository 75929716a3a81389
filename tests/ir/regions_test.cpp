// A node lives in the outermost region where its operands live.
#include "ir/regions.h"

#include <gtest/gtest.h>

#include "ir/loop.h"
#include "tests/support/make.h"
#include "tests/support/random_program.h"

namespace imp {
namespace {

using test::input;
using test::number;
using test::output;

struct TwoPhases {
  Program p;
  Expr r = input(p, "r", f32, Rate::frame), k = input(p, "k", f32, Rate::cell), x = input(p, "x");
  Expr third = number(p, 1) / number(p, 3);
  Expr frame = r * third, cell = frame + k, ray = cell * x, hoisted, inside, between, second, last;

  TwoPhases() {
    Loop march(p, "march", 8);
    const Expr t = march.state("t", x);
    hoisted = x * x;  // built within the phase, needs nothing of it
    inside = t + hoisted;
    march.next(t, inside);
    march.again_while(inside < ray);
    between = march.result(t) * 2.0;
    Loop refine(p, "refine", 4);
    const Expr u = refine.state("u", between);
    second = u * r;
    refine.next(u, second);
    last = refine.result(u) + march.result(t);
    output(p, "last", last);
  }
};

TEST(Regions, each_node_in_its_own) {
  const TwoPhases w;
  const auto region = regions(w.p);
  const auto of = [&](Expr e) { return region[e.id.index]; };
  EXPECT_EQ(of(w.third), Region::constant());
  EXPECT_EQ(of(w.frame), Region::of(Rate::frame));
  EXPECT_EQ(of(w.cell), Region::of(Rate::cell));
  EXPECT_EQ(of(w.ray), Region::of(Rate::ray));
  EXPECT_EQ(of(w.hoisted), Region::of(Rate::ray));
  EXPECT_EQ(of(w.inside), Region::in_phase(0));
  EXPECT_EQ(of(w.between), Region::after_phase(0));
  EXPECT_EQ(of(w.second), Region::in_phase(1));
  EXPECT_EQ(of(w.last), Region::after_phase(1));
}

TEST(Regions, are_ordered_from_the_outside_in_and_in_time) {
  EXPECT_LT(Region::constant(), Region::of(Rate::frame));
  EXPECT_LT(Region::of(Rate::frame), Region::of(Rate::cell));
  EXPECT_LT(Region::of(Rate::cell), Region::of(Rate::ray));
  EXPECT_LT(Region::of(Rate::ray), Region::in_phase(0));
  EXPECT_LT(Region::in_phase(0), Region::after_phase(0));
  EXPECT_LT(Region::after_phase(0), Region::in_phase(1));
  EXPECT_TRUE(Region::in_phase(3).inside_a_phase());
  EXPECT_FALSE(Region::after_phase(3).inside_a_phase());
  EXPECT_FALSE(Region::of(Rate::ray).inside_a_phase());
}

TEST(Schedule, has_what_is_needed_once_and_after_its_operands) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Program p = test::random_program(seed, {.phases = seed % 3, .tables = true, .calls = true});
    const auto region = regions(p);
    std::vector<bool> done(p.graph.size());
    for (std::uint32_t i = 0; i < done.size(); ++i) {
      const Op op = p.graph[Id{i}].op;
      done[i] = op == Op::constant || op == Op::input || op == Op::state || op == Op::result;
    }
    const auto nodes = schedule(p);
    for (std::uint32_t rank = 0; rank < nodes.size(); ++rank)
      for (const Id id : nodes[rank]) {
        EXPECT_EQ(region[id.index].rank, rank);
        EXPECT_FALSE(done[id.index]);
        for (const Id arg : p.graph[id].args) EXPECT_TRUE(done[arg.index]) << "seed " << seed;
        done[id.index] = true;
      }
    for (const Output& out : p.outputs) EXPECT_TRUE(done[out.id.index]);
  }
}

TEST(Schedule, leaves_out_what_is_dead) {
  Program p;
  const Expr x = input(p, "x");
  x * 3.0;
  output(p, "f", x + 1.0);
  EXPECT_EQ(schedule(p)[Region::of(Rate::ray).rank], (std::vector{p.outputs[0].id}));
}

}  // namespace
}  // namespace imp
