// No rewrite changes where f has a value, by a second opinion on what has one: ball arithmetic.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "passes/canonicalize.h"
#include "passes/chebyshev.h"
#include "passes/economize.h"
#include "passes/horner.h"
#include "passes/pass.h"
#include "passes/power.h"
#include "passes/reassociate.h"
#include "passes/recognize_chebyshev.h"
#include "passes/specialize.h"
#include "passes/surface_passes.h"
#include "tests/frontend/parse.h"
#include "tests/passes/promise.h"
#include "tests/support/ball.h"
#include "tests/support/every_form.h"
#include "tests/support/random_domains.h"

namespace imp::test {
namespace {

using State = Ball::State;
using Place = std::array<double, 4>;  // x, y, z, a

constexpr std::array<Range, 4> domain{{{-2, 2}, {-2, 2}, {-2, 2}, {-2, 2}}};

// In the domain; ends of domains of definition are among them.
Place place(Random& random) {
  Place result;
  for (double& each : result)
    each = random.one_in(2) ? static_cast<double>(random.below(9)) / 2 - 2 : random.between(-2, 2);
  return result;
}

Ball value(const Program& f, const Place& at) { return ball_values(f, at)[0]; }

Program bits_by_kernel_passes(const Program& f) {
  std::vector<Pass> passes;
  for (const Pass& pass : kernel_passes())
    if (pass.preserves == Preserves::bits) passes.push_back(pass);
  return run_passes(f, passes);
}
Program whole(const Program& f) { return simplified(f); }
Program over_domain(const Program& f) { return specialize(f, std::span(domain).first(f.inputs.size())); }
Program drawn(const Program& f) { return simplified(over_domain(f)); }

// One place for many counts: that the formulas test anything.
struct Seen {
  int defined = 0, undefined = 0;
};

bool same_domain(const Program& f, const Program& g, Seen* seen = nullptr) {
  Random random(3);
  for (int i = 0; i < 12; ++i) {
    const Place at = place(random);
    const Ball was = value(f, at), is = value(g, at);
    if (was.is(State::unknown) || is.is(State::unknown)) continue;
    if (was.state() != is.state()) return false;
    if (was.is(State::number) && !arb_overlaps(was.get(), is.get())) return false;
    if (seen) ++(was.is(State::number) ? seen->defined : seen->undefined);
  }
  return true;
}

class KeepsDomain : public Promises {};

TEST_P(KeepsDomain, of_random_formulas) {
  const auto run = GetParam().run;
  Seen seen;
  for (std::uint64_t seed = 1; seed <= 1500 && !HasFailure(); ++seed) {
    const Program f = random_domains(seed, 1 + static_cast<int>(seed % 3));
    report("another domain", seed, f, [&](const Program& q) { return !same_domain(q, run(q)); });
    same_domain(f, run(f), &seen);
  }
  EXPECT_GT(seen.defined, 3000);
  EXPECT_GT(seen.undefined, 3000);
}

INSTANTIATE_TEST_SUITE_P(Passes, KeepsDomain,
                         testing::Values(Promise{"recognize_chebyshev", recognize_chebyshev},
                                         Promise{"horner", horner}, Promise{"reassociate", reassociate},
                                         Promise{"simplified", whole}, Promise{"specialize", over_domain},
                                         Promise{"drawn", drawn}, Promise{"canonicalize", canonicalize},
                                         Promise{"powers", reduce_powers},
                                         Promise{"chebyshev", reduce_chebyshev},
                                         Promise{"kernel", bits_by_kernel_passes}),
                         [](const auto& test) { return test.param.name; });

// Where f has a value the numerator has one; where there is none either has none, or there is a pole.
TEST(KeepsDomain, of_fractions) {
  Seen seen;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    const Program f = simplified(random_domains(seed, 1 + static_cast<int>(seed % 3)));
    const Fraction parts = searched(f);
    if (!parts.poles) continue;
    Random random(seed);
    for (int i = 0; i < 12; ++i) {
      const Place at = place(random);
      const Ball was = value(f, at), above = value(parts.numerator, at), pole = value(*parts.poles, at);
      const bool broken = pole.is(State::unknown) || pole.is(State::none) || arb_contains_zero(pole.get());
      if (was.is(State::number)) {
        ASSERT_FALSE(above.is(State::none)) << seed << '\n' << to_text(f);
        const bool zero = arb_is_zero(was.get()) != 0 && above.is(State::number);
        ASSERT_TRUE(!zero || arb_contains_zero(above.get())) << seed << '\n' << to_text(f);
        ++seen.defined;
      } else if (was.is(State::none)) {
        ASSERT_TRUE(broken || !above.is(State::number)) << seed << '\n' << to_text(f);
        ++seen.undefined;
      }
    }
  }
  EXPECT_GT(seen.defined, 1000);
  EXPECT_GT(seen.undefined, 1000);
}

TEST(KeepsDomain, of_what_is_economized) {
  int cuts = 0;
  for (std::uint64_t seed = 1; seed <= 1500; ++seed) {
    Program f = random_domains(seed, 1 + static_cast<int>(seed % 3));
    const Expr x{&f.graph, f.inputs[0].id}, sum{&f.graph, f.outputs[0].id};
    f.outputs[0].id = (sum - make(Op::powi, x, constant_like(x, 7)) / 1024.0).id;
    const Economized near = economize(f, domain, 0.5);
    cuts += near.error > 0;
    Random random(seed);
    for (int i = 0; i < 12; ++i) {
      const Place at = place(random);
      const Ball was = value(f, at);
      Ball is = value(near.f, at);
      if (was.is(State::unknown) || is.is(State::unknown)) continue;
      ASSERT_EQ(was.state(), is.state()) << seed << '\n' << to_text(f) << to_text(near.f);
      if (!was.is(State::number)) continue;
      arb_add_error(is.get(), Ball(near.error).get());
      ASSERT_TRUE(arb_overlaps(was.get(), is.get())) << seed << '\n' << to_text(f) << to_text(near.f);
    }
  }
  EXPECT_GT(cuts, 1000);
}

class Defined : public testing::TestWithParam<Inclusion> {};

// No enclosure calls f defined on a box that holds a place without a value, and each holds the values.
TEST_P(Defined, nowhere_where_a_place_has_no_value) {
  int proven = 0, undefined = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Program f = random_domains(seed, 1 + static_cast<int>(seed % 2));
    const Program whole = simplified(f), numerator = searched(whole).numerator;
    for (const auto& [g, meant] : {std::pair(f, f), std::pair(whole, f), std::pair(numerator, numerator)}) {
      Diagnostics unused;
      const auto boxes = extension(g, *GetParam().enclose, seed % 2 == 0 ? f32 : f64, unused);
      if (!boxes) continue;
      const auto kernel = interpret(run_passes(*boxes, kernel_passes()));
      Random random(seed);
      for (int i = 0; i < 20; ++i) {
        const Place at = place(random);
        const double width = random.one_in(3) ? 0 : std::exp2(-random.between(0, 12));
        std::vector<double> ends;
        for (const double each : at) ends.insert(ends.end(), {each - width * random.unit(), each + width});
        const auto v = evaluate(*kernel, ends);
        const Ball is = value(meant, at);
        ASSERT_FALSE(is.is(State::none) && v[2] != 0) << seed << '\n' << to_text(g);
        ASSERT_FALSE(is.certainly_outside(v[0], v[1])) << seed << '\n' << to_text(g);
        undefined += is.is(State::none);
        proven += v[2] != 0;
      }
    }
  }
  EXPECT_GT(proven, 20);
  EXPECT_GT(undefined, GetParam().name == "bernstein" ? -1 : 300);
}

INSTANTIATE_TEST_SUITE_P(Forms, Defined, every_form(), form_name);

// Those that were hits where f has no value.
TEST(KeepsDomain, of_cancelled_parts_beside_chebyshev_polynomials) {
  const auto expect_none = [](const char* text, const Place& at) {
    const Program f = surface(text);
    for (const Program& g : {simplified(f), searched(simplified(f)).numerator, drawn(f)})
      EXPECT_TRUE(value(g, at).is(State::none)) << text << '\n' << to_text(g);
    EXPECT_TRUE(std::isnan(evaluate(bits_by_kernel_passes(f), std::span(at).first(3))[0])) << text;
  };
  expect_none("4*x^3 - 3*x + log(x - 5)^0 - 1.2", {-0.83, 0, 0, 0});
  expect_none("4*x^3 - 3*x + sqrt(x - 5)^0*0.5", {-0.83, 0, 0, 0});
  expect_none("4*x^3 - 3*x + T(0, log(x - 5)) - 1.2", {-0.83, 0, 0, 0});
  expect_none("(cos(x)^8 - cos(x)^2/5)*T(0, log(y - 5))", {1, 1, 1, 0});
}

// What has a value everywhere is no obstacle.
TEST(KeepsDomain, and_powers_of_coordinates_are_seen_through) {
  const Program f = recognize_chebyshev(surface("x^0 + 4*x^3 - 3*x + (x + y)^0 - 2"));
  EXPECT_EQ(f.graph[f.outputs[0].id].op, Op::chebyshev) << to_text(f);
}

}  // namespace
}  // namespace imp::test
