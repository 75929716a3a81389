// Constants against known digits, and against MPFR one op at a time.
#include "passes/constants.h"

#include <gtest/gtest.h>
#include <mpfr.h>

#include <random>

#include "ir/expr.h"
#include "ir/meaning.h"

namespace imp {
namespace {

// What a Program of constants is built from, and its value.
struct Constants {
  Program p;
  Expr operator()(double value, Type type = f64) { return {&p.graph, p.graph.constant(type, value)}; }
  Enclosure value(Expr e) { return value(e.id); }
  Enclosure value(Truth t) { return value(t.id); }
  Enclosure value(Id id) {
    const auto value = constant_values(p)[id.index];
    EXPECT_TRUE(value.has_value());
    return value.value_or(Enclosure{});
  }
};

bool empty(const Enclosure& e) {
  return e.lo > e.hi && std::isnan(e.nearest) && std::isnan(e.nearest_float) && !e.continuous;
}

// The number that these digits are, rounded as asked.
double digits(const char* text, mpfr_rnd_t round) {
  mpfr_t number;
  mpfr_init2(number, 300);
  mpfr_set_str(number, text, 10, MPFR_RNDN);
  const double value = mpfr_get_d(number, round);
  mpfr_clear(number);
  return value;
}

void expect_digits(const Enclosure& e, const char* text) {
  EXPECT_EQ(e.lo, digits(text, MPFR_RNDD)) << text;
  EXPECT_EQ(e.hi, digits(text, MPFR_RNDU)) << text;
  EXPECT_EQ(e.nearest, digits(text, MPFR_RNDN)) << text;
  EXPECT_TRUE(e.continuous) << text;
  mpfr_t number;
  mpfr_init2(number, 300);
  mpfr_set_str(number, text, 10, MPFR_RNDN);
  EXPECT_EQ(e.nearest_float, mpfr_get_flt(number, MPFR_RNDN)) << text;
  mpfr_clear(number);
}

TEST(Constants, known_digits) {
  Constants c;
  expect_digits(c.value(sqrt(c(5))), "2.236067977499789696409173668731276");
  expect_digits(c.value((1.0 + sqrt(c(5))) / 2.0), "1.618033988749894848204586834365638");
  expect_digits(c.value(make(Op::pow, c(2), c(1) / c(3))), "1.259921049894873164767210607278228");
  expect_digits(c.value(make(Op::cbrt, c(2))), "1.259921049894873164767210607278228");
  expect_digits(c.value(make(Op::exp, c(1))), "2.718281828459045235360287471352662");
  expect_digits(c.value(4.0 * make(Op::atan, c(1))), "3.141592653589793238462643383279503");
  expect_digits(c.value(make(Op::acos, c(-1))), "3.141592653589793238462643383279503");
  expect_digits(c.value(c(1) / c(10)), "0.1");
  expect_digits(c.value(make(Op::log, c(10))), "2.302585092994045684017991454684364");
  expect_digits(c.value(make(Op::sin, c(1))), "0.841470984807896506652502321630299");
  expect_digits(c.value(make(Op::cos, c(1))), "0.540302305868139717400936607442977");
  expect_digits(c.value(make(Op::tan, c(1))), "1.557407724654902230506974807458360");
  expect_digits(c.value(make(Op::sinh, c(1))), "1.175201193643801456882381850595601");
  expect_digits(c.value(make(Op::cosh, c(1))), "1.543080634815243778477905620757062");
  expect_digits(c.value(make(Op::tanh, c(1))), "0.761594155955764888119458282604794");
  expect_digits(c.value(make(Op::asinh, c(1))), "0.881373587019543025232609324979792");
  expect_digits(c.value(make(Op::acosh, c(2))), "1.316957896924816708625046347307969");
  expect_digits(c.value(make(Op::atanh, c(0.5))), "0.549306144334054845697622618461253");
  expect_digits(c.value(make(Op::asin, c(0.5))), "0.523598775598298873077107230546584");
  expect_digits(c.value(make(Op::atan2, c(1), c(2))), "0.463647609000806116214256231461214");
  expect_digits(c.value(make(Op::atan2, c(1), c(-2))), "2.677945044588987122248387151821589");
  expect_digits(c.value(make(Op::powi, c(1) / c(3), c(-3)) / 10.0), "2.7");
  expect_digits(c.value(make(Op::mod, c(7) / c(3), c(-3))),
                "-0.666666666666666666666666666666666666666666666667");
  expect_digits(c.value(fma(c(1) / c(10), c(3), c(1))), "1.3");
  expect_digits(c.value(abs(c(0) - sqrt(c(5)))), "2.236067977499789696409173668731276");
  expect_digits(c.value(min(sqrt(c(5)), make(Op::exp, c(1)))), "2.236067977499789696409173668731276");
  expect_digits(c.value(max(sqrt(c(5)), make(Op::exp, c(1)))), "2.718281828459045235360287471352662");
  expect_digits(c.value(make(Op::sin, c(1e300))), "-0.8178819121159085970458852827554262");
}

TEST(Constants, exact_ones_are_points) {
  Constants c;
  const auto expect = [&](Expr e, double exact) {
    const Enclosure v = c.value(e);
    EXPECT_EQ(v.lo, exact);
    EXPECT_EQ(v.hi, exact);
    EXPECT_EQ(v.nearest, exact);
  };
  expect(c(0.1), 0.1);
  expect(c(0.1f, f32), 0.1f);
  expect(make(Op::pow, c(2), c(10)), 1024);
  expect(make(Op::pow, c(4), c(0.5)), 2);
  expect(make(Op::pow, c(0), c(0)), 1);
  expect(make(Op::pow, sqrt(c(2)), c(0)), 1);
  expect(make(Op::pow, c(0), sqrt(c(2))), 0);
  expect(make(Op::pow, c(1), sqrt(c(2))), 1);
  expect(make(Op::pow, c(2), c(-3)), 0.125);
  expect(make(Op::exp, c(0)), 1);
  expect(make(Op::log, c(1)), 0);
  expect(make(Op::acosh, c(1)), 0);
  expect(make(Op::cos, c(0)), 1);
  expect(make(Op::atan2, c(0), c(2)), 0);
  expect(make(Op::cbrt, c(-27)), -3);
  expect(floor(sqrt(c(5))), 2);
  expect(ceil(sqrt(c(5))), 3);
  expect(make(Op::sign, -sqrt(c(5))), -1);
  expect((c(1) / c(10)) * 0.0, 0);
}

// As min and max have it (ir/ops.def): where the first may have no value the second may be the answer.
TEST(Constants, the_second_where_the_first_has_no_value) {
  Constants c;
  const Expr root = sqrt(c(2)), none = sqrt(-root), perhaps = sqrt(root * root - 2.0);
  for (const Op op : {Op::min, Op::max}) {
    const Enclosure second = c.value(make(op, none, c(3) / c(4)));
    EXPECT_EQ(second.lo, 0.75);
    EXPECT_EQ(second.hi, 0.75);
    EXPECT_TRUE(second.continuous);
    const Enclosure either = c.value(make(op, perhaps, c(3) / c(4)));
    EXPECT_LE(either.lo, op == Op::min ? 0 : 0.75);
    EXPECT_EQ(either.hi, 0.75);
    EXPECT_FALSE(either.continuous);
  }
}

TEST(Constants, empty_where_there_is_no_value) {
  Constants c;
  const Expr root = sqrt(c(2));
  EXPECT_TRUE(empty(c.value(sqrt(-root))));
  EXPECT_TRUE(empty(c.value(make(Op::log, -root))));
  EXPECT_TRUE(empty(c.value(make(Op::log, root * 0.0))));
  EXPECT_TRUE(empty(c.value(root / (root * 0.0))));
  EXPECT_TRUE(empty(c.value(make(Op::powi, root * 0.0, c(-2)))));
  EXPECT_TRUE(empty(c.value(make(Op::pow, -root, c(2)))));
  EXPECT_TRUE(empty(c.value(make(Op::pow, root * 0.0, c(-1)))));
  EXPECT_TRUE(empty(c.value(make(Op::acosh, c(0.5)))));
  EXPECT_TRUE(empty(c.value(make(Op::asin, root))));
  EXPECT_TRUE(empty(c.value(make(Op::acos, root))));
  EXPECT_TRUE(empty(c.value(make(Op::atanh, root))));
  EXPECT_TRUE(empty(c.value(make(Op::atanh, c(1)))));
  EXPECT_TRUE(empty(c.value(make(Op::mod, root, root * 0.0))));
  EXPECT_TRUE(empty(c.value(1.0 + min(root, sqrt(-root)))));
  EXPECT_TRUE(empty(c.value(make(Op::powi, sqrt(-root), c(0)))));
  EXPECT_TRUE(empty(c.value(c(NAN))));
}

TEST(Constants, what_cannot_be_decided) {
  Constants c;
  const Expr two = sqrt(c(2)) * sqrt(c(2));  // near 2, on either side
  const Enclosure below = c.value(floor(two));
  EXPECT_EQ(below.lo, 1);
  EXPECT_EQ(below.hi, 2);
  EXPECT_EQ(below.nearest, 2);
  EXPECT_FALSE(below.continuous);
  const Enclosure above = c.value(ceil(two));
  EXPECT_EQ(above.lo, 2);
  EXPECT_EQ(above.hi, 3);
  EXPECT_EQ(above.nearest, 2);
  const Enclosure sign = c.value(make(Op::sign, two - 2.0));
  EXPECT_EQ(sign.lo, -1);
  EXPECT_EQ(sign.hi, 1);
  EXPECT_EQ(sign.nearest, 0);
  const Enclosure choice = c.value(select(two <= 2.0, c(10), c(20)) + 1.0);
  EXPECT_EQ(choice.lo, 11);
  EXPECT_EQ(choice.hi, 21);
  EXPECT_EQ(choice.nearest, 11);
  EXPECT_FALSE(choice.continuous);
  EXPECT_EQ(c.value(equal(two, c(2))).nearest, 1);
  EXPECT_EQ(c.value(two < 2.0).nearest, 0);
  EXPECT_EQ(c.value(two < 2.0).hi, 1);
  EXPECT_EQ(c.value(sqrt(c(5)) < 2.0).hi, 0);
  EXPECT_EQ(c.value(sqrt(c(5)) > 2.0 && !(sqrt(c(5)) >= 3.0)).lo, 1);
  const Enclosure pole = c.value(1.0 / (two - 2.0));
  EXPECT_EQ(pole.lo, -INFINITY);
  EXPECT_EQ(pole.hi, INFINITY);
  EXPECT_FALSE(pole.continuous);
  const Enclosure root = c.value(sqrt(two - 2.0));
  EXPECT_EQ(root.lo, 0);
  EXPECT_FALSE(root.continuous);
  // A comparison with what may have no value is not known to hold.
  EXPECT_EQ(c.value(sqrt(two - 2.0) < 1.0).lo, 0);
}

TEST(Constants, jumps_are_told) {
  Constants c;
  EXPECT_TRUE(c.value(floor(sqrt(c(5)))).continuous);
  EXPECT_FALSE(c.value(floor(make(Op::pow, c(4), c(0.5)))).continuous);
  EXPECT_FALSE(c.value(make(Op::atan2, c(0), c(-1))).continuous);
  EXPECT_TRUE(c.value(make(Op::atan2, c(0), c(1))).continuous);
  EXPECT_FALSE(c.value(make(Op::atan2, c(0), c(0))).continuous);
  EXPECT_FALSE(c.value(make(Op::pow, c(0), c(0))).continuous);
}

TEST(Constants, out_of_range_is_outward) {
  Constants c;
  const Enclosure huge = c.value(make(Op::powi, c(10) / c(3), c(1000)));
  EXPECT_EQ(huge.lo, std::numeric_limits<double>::max());
  EXPECT_EQ(huge.hi, INFINITY);
  EXPECT_EQ(huge.nearest, INFINITY);
  const Enclosure tiny = c.value(make(Op::powi, c(10) / c(3), c(-1000)));
  EXPECT_EQ(tiny.lo, 0);
  EXPECT_EQ(tiny.hi, 5e-324);
  EXPECT_EQ(tiny.nearest, 0);
  const Enclosure denormal = c.value(c(1e-310) / c(3));
  EXPECT_LT(denormal.lo, denormal.hi);
  EXPECT_EQ(denormal.nearest, 1e-310 / 3);
  EXPECT_EQ(denormal.nearest_float, 0);
  const Enclosure float_only = c.value(c(1e39) / c(3));
  EXPECT_EQ(float_only.nearest_float, 3.3333333e38f);
  EXPECT_EQ(c.value(c(1e40) / c(3)).nearest_float, INFINITY);
  EXPECT_EQ(c.value(c(INFINITY)).nearest, INFINITY);
  const Enclosure back = c.value(make(Op::log, make(Op::exp, c(1000))));
  EXPECT_EQ(back.nearest, 1000);
}

// sin(10^(10^9)) would need a thousand million digits of pi.
TEST(Constants, a_sine_too_far_out_is_anything) {
  Constants c;
  const Expr far = make(Op::pow, c(10), c(1e9));
  const Enclosure e = c.value(make(Op::sin, far));
  EXPECT_EQ(e.lo, -1);
  EXPECT_EQ(e.hi, 1);
  EXPECT_TRUE(std::isnan(e.nearest));
  EXPECT_EQ(c.value(make(Op::tan, -far)).hi, INFINITY);
}

// Rounded once: straight to float, never by way of a double.
TEST(Constants, float_is_rounded_once) {
  Constants c;
  const double tie = 1 + 0x1p-24;
  const Enclosure e = c.value(tie + c(0x1p-60) / c(3));  // above the tie by less than a double holds
  EXPECT_EQ(e.nearest, tie);
  EXPECT_EQ(e.nearest_float, 1 + 0x1p-23f);
}

TEST(Constants, exponents_are_taken_apart) {
  Constants c;
  EXPECT_EQ(c.value(make(Op::exponent, sqrt(c(5)) * -4.0)).nearest, 3);
  EXPECT_EQ(c.value(make(Op::exponent, sqrt(c(5)) * 0.0)).hi, -INFINITY);
  EXPECT_EQ(c.value(make(Op::scale2, c(1), sqrt(c(5)))).nearest, 4);
}

TEST(Constants, other_nodes_have_none) {
  Program p;
  const Expr x{&p.graph, add_input(p, "x", f64, Rate::frame)};
  const Expr y = x * 2.0;
  EXPECT_FALSE(constant_values(p)[y.id.index].has_value());
}

// Every op on random numbers: ordered, tight, and around the value that libm finds.
TEST(Constants, every_op_is_tight) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> spread(-3, 3);
  for (int round = 0; round < 200; ++round) {
    Constants c;
    const double a = spread(random), b = spread(random), d = spread(random);
    for (int i = 0; i < op_count; ++i) {
      const Op op = static_cast<Op>(i);
      const OpKind kind = info(op).kind;
      if (kind != OpKind::real && kind != OpKind::elementary) continue;
      if (takes_integers(op) || op == Op::exponent || op == Op::scale2) continue;
      const std::array<Expr, 3> args{c(a), c(b), c(d)};
      std::vector<Id> ids;
      for (int k = 0; k < info(op).arity; ++k) ids.push_back(args[static_cast<std::size_t>(k)].id);
      const Id id = c.p.graph.add(op, ids);
      const Enclosure e = c.value(id);
      const double value = meaning::real<double>(op, a, b, d);
      if (std::isnan(value)) {
        EXPECT_TRUE(empty(e)) << info(op).name << ' ' << a << ' ' << b;
        continue;
      }
      EXPECT_LE(e.lo, e.nearest) << info(op).name << ' ' << a << ' ' << b;
      EXPECT_LE(e.nearest, e.hi) << info(op).name << ' ' << a << ' ' << b;
      EXPECT_LE(e.hi, std::nextafter(e.lo, INFINITY)) << info(op).name << ' ' << a << ' ' << b;
      EXPECT_EQ(e.nearest_float, static_cast<float>(e.nearest)) << info(op).name;
      const double slack = op == Op::mod ? 1e-14 : 4e-16 * std::abs(value);
      EXPECT_NEAR(e.nearest, value, slack) << info(op).name << ' ' << a << ' ' << b;
    }
  }
}

}  // namespace
}  // namespace imp
