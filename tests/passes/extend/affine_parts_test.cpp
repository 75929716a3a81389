// The ops on affine forms charge every rounding to e, whichever way plain ops round: forms whose parts are
// inputs, where nothing but roundings is to be charged, beside what is exact.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>

#include "passes/extend/affine_lines.h"
#include "passes/extend/forms.h"
#include "tests/support/evaluate.h"
#include "tests/support/exact.h"
#include "tests/support/make.h"
#include "tests/support/random.h"
#include "tests/support/rounded_down.h"

namespace imp::test {
namespace {

struct AffineOp {
  const char* name;
  std::function<Affine(const Affine& a, const Affine& b, Expr k)> build;
  std::function<long double(long double a, long double b, long double k)> exact;
  bool of_points = false;         // a has no radius: else there is a remainder
  bool second_is_a_point = true;  // b has none
  double off = 0;                 // of an exact factor, in eps
};

const AffineOp ops[] = {
    {"add", [](auto& a, auto& b, Expr) { return affine::add(a, b); },
     [](auto a, auto b, auto) { return a + b; }, false, false},
    {"sub", [](auto& a, auto& b, Expr) { return affine::sub(a, b); },
     [](auto a, auto b, auto) { return a - b; }, false, false},
    {"mul", [](auto& a, auto& b, Expr) { return affine::mul(a, b); },
     [](auto a, auto b, auto) { return a * b; }},
    {"square", [](auto& a, auto&, Expr) { return affine::square(a); },
     [](auto a, auto, auto) { return a * a; }, true},
    {"cube", [](auto& a, auto&, Expr) { return affine::cube(a); },
     [](auto a, auto, auto) { return a * a * a; }, true},
    {"scale", [](auto& a, auto&, Expr) { return affine::scale(a, 0.7109375, true); },
     [](auto a, auto, auto) { return a * 0.7109375L; }},
    {"scale_a_little_less", [](auto& a, auto&, Expr) { return affine::scale(a, 0.7109375, false); },
     [](auto a, auto, auto) { return a * 0.7109375L; }, false, true, -2},
    {"scale_a_little_more", [](auto& a, auto&, Expr) { return affine::scale(a, 0.7109375, false); },
     [](auto a, auto, auto) { return a * 0.7109375L; }, false, true, 2},
    {"line", [](auto& a, auto& b, Expr k) { return affine::line(a, k, {-b.c, b.c}, 100); },
     [](auto a, auto b, auto k) { return k * a + b; }},
};

// AF1 and AF2.
void output_parts(Program& program, const Affine& form) {
  output(program, "c", form.c);
  for (const Expr x : form.x) output(program, "x", x);
  output(program, "e nlo", form.e.nlo);
  output(program, "e hi", form.e.hi);
}

class AffineParts : public testing::TestWithParam<std::tuple<AffineOp, bool>> {};

TEST_P(AffineParts, charge_every_rounding) {
  const auto& [op, signed_errors] = GetParam();
  Program program{.name = "op"};
  const auto form = [&](const std::string& name) {
    const Expr c = input(program, name), x1 = input(program, name + "1"), x2 = input(program, name + "2");
    return Affine{c, {x1, x2}, affine::both(zero(c)), 10, 0, signed_errors};
  };
  const Affine a = form("a"), b = form("b");
  const Affine result = op.build(a, b, input(program, "k"));
  output_parts(program, result);
  const auto up = interpret(upward(program)), down = interpret(upward(rounded_down(program)));

  Random random(0xaf1);
  const auto number = [&] { return static_cast<double>(static_cast<float>(random.between(-2, 2))); };
  for (int i = 0; i < 3000; ++i) {
    std::vector<double> in{number(), 0, 0, number(), 0, 0, number(), 0};
    if (!op.of_points) in[1] = number(), in[2] = number();
    if (!op.second_is_a_point) in[4] = number(), in[5] = number();
    for (const auto& kernel : {up.get(), down.get()}) {
      const auto v = evaluate(*kernel, in);
      for (const int corner : {0, 1, 2, 3}) {
        const long double u1 = corner % 2 ? 1 : -1, u2 = corner / 2 ? 1 : -1;
        const auto at = [&](const double* parts) { return parts[0] + u1 * parts[1] + u2 * parts[2]; };
        const long double exact =
            op.exact(at(&in[0]), at(&in[3]), in[6]) * (1 + op.off * static_cast<long double>(0x1p-23));
        ASSERT_LE(at(v.data()) - exact, v[3] + 1e-16L)
            << fmt::format("{} of {}: {}", op.name, fmt::join(in, ", "), fmt::join(v, ", "));
        ASSERT_LE(exact - at(v.data()), v[4] + 1e-16L)
            << fmt::format("{} of {}: {}", op.name, fmt::join(in, ", "), fmt::join(v, ", "));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Affine, AffineParts, testing::Combine(testing::ValuesIn(ops), testing::Bool()),
                         [](const auto& test) {
                           const AffineOp& op = std::get<0>(test.param);
                           return std::string(op.name) + (std::get<1>(test.param) ? "_af2" : "");
                         });

struct SignedOp {
  const char* name;
  std::function<Affine(const Affine& a, const Affine& b, Expr k)> build;
  std::function<long double(long double a, long double b, long double k)> exact;
};
void PrintTo(const SignedOp& op, std::ostream* out) { *out << op.name; }

const SignedOp signed_ops[] = {
    {"neg", [](auto& a, auto&, Expr) { return affine::neg(a); }, [](auto a, auto, auto) { return -a; }},
    {"add", [](auto& a, auto& b, Expr) { return affine::add(a, b); },
     [](auto a, auto b, auto) { return a + b; }},
    {"sub", [](auto& a, auto& b, Expr) { return affine::sub(a, b); },
     [](auto a, auto b, auto) { return a - b; }},
    {"mul", [](auto& a, auto& b, Expr) { return affine::mul(a, b); },
     [](auto a, auto b, auto) { return a * b; }},
    {"square", [](auto& a, auto&, Expr) { return affine::square(a); },
     [](auto a, auto, auto) { return a * a; }},
    {"cube", [](auto& a, auto&, Expr) { return affine::cube(a); },
     [](auto a, auto, auto) { return a * a * a; }},
    {"scale", [](auto& a, auto&, Expr) { return affine::scale(a, 0.7109375, true); },
     [](auto a, auto, auto) { return a * 0.7109375L; }},
    {"scale_and_turn", [](auto& a, auto&, Expr) { return affine::scale(a, -2, true); },
     [](auto a, auto, auto) { return -2 * a; }},
    {"line", [](auto& a, auto&, Expr k) { return affine::line(a, k, affine::both(one(k)), 100); },
     [](auto a, auto b, auto k) { return k * a + std::clamp(b, -1.0L, 1.0L); }},
    {"select", [](auto& a, auto& b, Expr k) { return affine::select(k > 0, a, b); },
     [](auto a, auto b, auto k) { return k > 0 ? a : b; }},
};

// Of operands with errors of any sign, whichever of their values are taken: at the ends of errors and symbols in the
// most.
class SignedErrors : public testing::TestWithParam<SignedOp> {};

TEST_P(SignedErrors, hold_whatever_the_operands_hold) {
  const SignedOp& op = GetParam();
  Program program{.name = "op"};
  const auto form = [&](const std::string& name) {
    const Expr c = input(program, name), x1 = input(program, name + "1"), x2 = input(program, name + "2");
    const Expr nlo = input(program, name + "nlo"), hi = input(program, name + "hi");
    return Affine{c, {x1, x2}, {nlo, hi}, 10, 0, true};
  };
  const Affine a = form("a"), b = form("b");
  const Affine result = op.build(a, b, input(program, "k"));
  output_parts(program, result);
  const auto up = interpret(upward(program)), down = interpret(upward(rounded_down(program)));

  Random random(0xaf2);
  const auto one_in = [&](double n) { return random.unit() * n < 1; };
  const auto number = [&](double lo) {
    return one_in(3) ? 0 : static_cast<double>(static_cast<float>(random.between(lo, 1)));
  };
  const auto share = [&] { return one_in(3) ? random.unit() : one_in(2) ? 1 : 0; };  // of what may come
  for (int i = 0; i < 3000; ++i) {
    std::vector<double> in;
    for (const double lo : {-1, -1, -1, 0, 0, -1, -1, -1, 0, 0, -1}) in.push_back(number(lo));
    for (const auto& kernel : {up.get(), down.get()}) {
      const auto v = evaluate(*kernel, in);
      for (int k = 0; k < 8; ++k) {
        const long double u1 = 2 * share() - 1, u2 = 2 * share() - 1;
        const auto at = [&](const double* parts) { return parts[0] + u1 * parts[1] + u2 * parts[2]; };
        const auto value = [&](const double* parts) {
          return at(parts) + std::lerp(-parts[3], parts[4], share());
        };
        const long double exact = op.exact(value(&in[0]), value(&in[5]), in[10]);
        const auto about = [&] {
          return fmt::format("{} of {}: {}", op.name, fmt::join(in, ", "), fmt::join(v, ", "));
        };
        ASSERT_LE(at(v.data()) - exact, v[3] + 1e-15L) << about();
        ASSERT_LE(exact - at(v.data()), v[4] + 1e-15L) << about();
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Affine, SignedErrors, testing::ValuesIn(signed_ops),
                         [](const auto& test) { return test.param.name; });

// Around 0: what AF2 is for.
TEST(SignedErrors, know_that_products_of_squares_are_not_negative) {
  Program program{.name = "products"};
  const Expr none = zero(input(program, "none")), unit = one(none);
  const auto variable = [&](std::size_t i) {
    Affine result{none, {none, none}, affine::both(none), 1, 0, true};
    result.x[i] = unit;
    return result;
  };
  const Affine x = variable(0), y = variable(1), xx = affine::square(x), yy = affine::square(y);
  const Affine zz = affine::mul(x, x), sum = affine::add(xx, yy);
  for (const Affine& form : {affine::mul(xx, yy), affine::mul(zz, sum), affine::square(affine::sub(sum, zz)),
                             affine::neg(affine::cube(affine::scale(sum, -2, true)))}) {
    const affine::Ends ends = affine::ends(form);
    output(program, "lo", -ends.nlo);
  }
  for (const double lo : evaluate(program, std::array{0.0})) EXPECT_GE(lo, -1e-4);
}

// At the ends and where the line is a tangent, what is left of the function lies within the rest.
void expect_rest_holds(affine::Line (*line)(Expr, Expr), long double (*f)(long double),
                       long double (*touches)(long double k)) {
  Program program{.name = "line"};
  const Expr lo = input(program, "lo"), hi = input(program, "hi");
  const auto [factor, rest] = line(lo, hi);
  output(program, "k", factor);
  output(program, "nlo", rest.nlo);
  output(program, "hi", rest.hi);
  const auto up = interpret(program), down = interpret(rounded_down(program));
  Random random(0x11e);
  for (int i = 0; i < 5000; ++i) {
    const double from = static_cast<float>(std::exp2(random.between(-8, 8)));
    const double to = static_cast<float>(from * (1 + random.unit()));
    for (const auto& kernel : {up.get(), down.get()}) {
      const auto v = evaluate(*kernel, std::array{from, to});
      for (const long double u :
           {static_cast<long double>(from), static_cast<long double>(to), touches(v[0])}) {
        const long double left = f(u) - v[0] * u, slack = 1e-17L * std::abs(f(u));
        ASSERT_LE(-left, v[1] + slack) << from << ' ' << to << ' ' << static_cast<double>(u);
        ASSERT_LE(left, v[2] + slack) << from << ' ' << to << ' ' << static_cast<double>(u);
      }
    }
  }
}

TEST(AffineLines, reciprocals_lie_beside_theirs) {
  expect_rest_holds(
      affine::reciprocal_line, [](long double u) { return 1 / u; },
      [](long double k) { return 1 / std::sqrt(-k); });
}

TEST(AffineLines, roots_lie_beside_theirs) {
  expect_rest_holds(
      affine::root_line, [](long double u) { return std::sqrt(u); },
      [](long double k) { return 1 / (4 * k * k); });
}

// A slope that overflows, of a form that cannot: no bound may be NaN.
TEST(AffineDomains, may_be_tiny) {
  using Build = Expr (*)(Expr x);
  constexpr Build builds[] = {
      [](Expr x) { return 1.0 / x; },
      [](Expr x) { return make(Op::log, x); },
      [](Expr x) { return sqrt(x); },
      [](Expr x) { return make(Op::log, sqrt(x)) + 1.0 / sqrt(x); },
  };
  for (const Build build : builds)
    for (const double least : {1e-10, 1e-16, 1e-20, 1e-25, 1e-32, 1e-37, 1e-39, 1e-44}) {
      Program f{.name = "f"};
      output(f, "f", build(input(f, "x", f64)));
      for (Form* form : {&affine_form, &affine_and_interval_form, &signed_affine_form}) {
        Program program{.name = "enclosure"};
        const Expr lo = input(program, "lo"), hi = input(program, "hi");
        const Interval side = interval(-lo, hi, {true, true});
        constexpr std::size_t variables[] = {0};
        const Range domain[] = {{least, 4 * least}};
        Diagnostics diagnostics;
        const auto value = (*form)(f, {{&side, 1}, variables, domain}, diagnostics)->front();
        output(program, "lo", value.lo());
        output(program, "hi", value.hi);
        const double from = static_cast<float>(1.5 * least), to = static_cast<float>(2.5 * least);
        const auto bounds = evaluate(program, {from, to});
        for (const double x : {from, to}) {
          const double exact = exact_values(f, std::array{x})[0].nearest;
          EXPECT_LE(bounds[0], exact) << least;
          EXPECT_GE(bounds[1], exact) << least;
        }
      }
    }
}

}  // namespace
}  // namespace imp::test
