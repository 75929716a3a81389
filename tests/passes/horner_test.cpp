// Horner's rule: what is factored out and what is not, and that it makes no enclosure wider.
#include "passes/horner.h"

#include <gtest/gtest.h>

#include "ir/text.h"
#include "passes/extend/forms.h"
#include "passes/power.h"
#include "tests/support/boxes.h"
#include "tests/support/catalogue.h"
#include "tests/support/cost.h"
#include "tests/support/make.h"
#include "tests/support/random_sums.h"

namespace imp {
namespace {

using test::cost;
using test::power;

struct Formula {
  Program program;
  Expr x = test::input(program, "x", f64), y = test::input(program, "y", f64),
       z = test::input(program, "z", f64);

  void is(Expr f) { test::output(program, "f", f); }
};

template <class Build>
Program formula(Build build) {
  Formula f;
  f.is(build(f.x, f.y, f.z));
  return compact(f.program);
}

// Horner of the one is the other.
template <class From, class To>
void expect_becomes(From from, To to) {
  const Program found = compact(horner(formula(from))), wanted = formula(to);
  EXPECT_TRUE(found == wanted) << to_text(found) << to_text(wanted);
}

template <class Build>
void expect_stays(Build build) {
  expect_becomes(build, build);
}

TEST(Horner, factors_out_what_most_terms_have) {
  expect_becomes([](Expr x, Expr y, Expr z) { return x * y + x * z; },
                 [](Expr x, Expr y, Expr z) { return x * (y + z); });
  expect_becomes([](Expr x, Expr y, Expr z) { return z - x * y - 2.0 * x * z; },
                 [](Expr x, Expr y, Expr z) { return z - x * (y + 2.0 * z); });
  expect_becomes([](Expr x, Expr y, Expr z) { return x * y + x * z + 3.0 * y + 3.0 * z; },
                 [](Expr x, Expr y, Expr z) { return (x + 3.0) * (y + z); });
}

TEST(Horner, knows_powers) {
  expect_becomes([](Expr x, Expr, Expr) { return power(x, 4) - 5.0 * power(x, 2); },
                 [](Expr x, Expr, Expr) { return power(x, 2) * (power(x, 2) - 5.0); });
  expect_becomes([](Expr x, Expr y, Expr) { return power(x, 3) * y + power(x, 3); },
                 [](Expr x, Expr y, Expr) { return power(x, 3) * (y + 1.0); });
  expect_becomes([](Expr x, Expr, Expr) { return power(x, 4) - power(x, 2); },
                 [](Expr x, Expr, Expr) { return power(x, 2) * (power(x, 2) - 1.0); });
}

TEST(Horner, leaves_powers_whole_where_an_enclosure_needs_them) {
  expect_stays([](Expr x, Expr, Expr) { return power(x, 2) - x; });
  expect_stays([](Expr x, Expr, Expr) { return power(x, 4) + power(x, 3) * 2.0; });
  expect_stays([](Expr x, Expr, Expr) { return power(x, 3) - 4.0 * x; });
}

TEST(Horner, leaves_what_is_factored_or_nothing_to_it) {
  expect_stays([](Expr x, Expr y, Expr z) { return (x + y) * (x - z) + y; });
  expect_stays([](Expr x, Expr y, Expr z) { return power(x, 2) + power(y, 2) + power(z, 2) - 1.0; });
  expect_stays([](Expr x, Expr y, Expr z) { return make(Op::sin, x * y) + make(Op::sin, x * z); });
  expect_stays([](Expr x, Expr y, Expr z) {  // the product is needed anyway
    return (x * y + x * z) * (x * y) * (x * z);
  });
}

TEST(Horner, never_takes_more_ops) {
  const auto ops = [](const Program& p) { return cost(reduce_powers(p)); };
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Program p = test::random_sums(seed);
    EXPECT_LE(ops(horner(p)), ops(p)) << to_text(p);
  }
}

// Widths over boxes; the mean of what `after` makes of those of `before`.
class Widths {
 public:
  Widths(const Program& before, const Program& after)
      : before_(interpret(extension(before))), after_(interpret(extension(after))) {}

  void add(std::span<const double> box) {
    const auto a = test::evaluate(*before_, box), b = test::evaluate(*after_, box);
    const double wide = a[1] - a[0], now = b[1] - b[0], size = std::max(std::abs(a[0]), std::abs(a[1]));
    if (!std::isfinite(wide) || wide < 1e-9 * size) return;  // rounding
    sum_ += now / wide;
    largest_ = std::max(largest_, now / wide);
    ++count_;
  }

  double largest() const { return largest_; }
  double mean() const { return count_ == 0 ? 1 : sum_ / static_cast<double>(count_); }

 private:
  static Program extension(const Program& p) {
    Diagnostics diagnostics;
    const auto result = imp::extension(p, interval_form, f64, diagnostics);
    if (!result) throw std::runtime_error(to_text(diagnostics));
    return *result;
  }

  std::unique_ptr<Kernel> before_, after_;
  double sum_ = 0, largest_ = 0;
  std::size_t count_ = 0;
};

TEST(Horner, makes_no_enclosure_wider) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Program p = test::random_sums(seed);
    p.outputs.resize(1);
    Widths widths(p, horner(p));
    test::Boxes boxes(seed);
    for (int i = 0; i < 20; ++i) {
      std::vector<double> box;
      for (std::size_t k = 0; k < p.inputs.size(); ++k) {
        const auto [lo, hi] = boxes.within(-2, 2);
        box.insert(box.end(), {lo, hi});
      }
      widths.add(box);
    }
    EXPECT_LE(widths.largest(), 1 + 1e-6) << to_text(p) << to_text(horner(p));
  }
}

TEST(Horner, makes_no_enclosure_of_the_catalogue_wider) {
  for (const test::SurfaceEntry* entry : test::all_entries()) {
    const Program f = test::model_of(*entry).surfaces[0].f;
    if (f.inputs.size() != 3) continue;
    const Program g = horner(f);
    Widths widths(f, g);
    test::Boxes boxes(1);
    for (int i = 0; i < 60; ++i) {
      std::vector<double> box;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto [lo, hi] = boxes.within(entry->domain.lo[axis], entry->domain.hi[axis]);
        box.insert(box.end(), {lo, hi});
      }
      widths.add(box);
    }
    EXPECT_LE(widths.largest(), 1 + 1e-6) << entry->id;
    if (entry->id == "tangle" || entry->id == "random_quintic") { EXPECT_LE(widths.mean(), 0.8); }
  }
}

}  // namespace
}  // namespace imp
