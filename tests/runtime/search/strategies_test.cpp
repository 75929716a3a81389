// Every strategy: what it refuses, how many steps it takes where it is at its best, and polynomials of which
// the roots are known.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "tests/support/cast.h"
#include "tests/support/effort.h"
#include "tests/support/random.h"

namespace imp::test {
namespace {

constexpr Ray along_x{{0, 0, 0}, {1, 0, 0}, 0, 1};

std::optional<std::string> refusal(const std::string& source, std::string_view search) {
  const Model model = model_of(source);
  Diagnostics diagnostics;
  if (cast_program(model.surfaces[0], *search_named(search), inclusions().front(), {}, f32, diagnostics))
    return std::nullopt;
  const Diagnostic& first = diagnostics.all().front();
  diagnostics.sources.add("test.imp", source);
  const Position place = position(diagnostics.sources, first.span);
  return fmt::format("{}:{}: {}", place.line, place.column, first.message);
}

TEST(Strategies, refuse_what_they_are_not_for) {
  const char* const wave = "x + y*\n  sin(z)";
  const std::string no_polynomial =
      "2:3: 'sin' makes this no polynomial in x, y, z; use --search=isolate or stackless";
  EXPECT_EQ(refusal(wave, "bernstein"), no_polynomial);
  EXPECT_EQ(refusal(wave, "polynomial"), no_polynomial);
  EXPECT_EQ(refusal(wave, "segment"), std::nullopt);
  EXPECT_EQ(refusal(wave, "newton"), std::nullopt);
  EXPECT_EQ(refusal(wave, "stackless"), std::nullopt);
  EXPECT_EQ(refusal("x^12 + y", "polynomial"), std::nullopt);
  EXPECT_EQ(refusal("x^13 + y", "polynomial"),
            "1:1: this polynomial is of degree 13, and --search=polynomial takes degrees up to 12; use "
            "--search=bernstein or stackless");
  EXPECT_EQ(refusal("x^32 + y", "bernstein"), std::nullopt);
  EXPECT_EQ(refusal("x^33 + y", "bernstein"), "1:1: this polynomial of degree 33 has too many coefficients");
  EXPECT_EQ(refusal("abs(x) + y", "bernstein"),
            "1:1: 'abs' makes this no polynomial in x, y, z; use --search=isolate or stackless");
}

Answer cast(const std::string& source, const char* search, const Ray& ray, Type type = f32) {
  return Caster(model_of(source), {.backend = Backend::interpreter, .precision = type}, {}, {},
                inclusions().front(), *search_named(search))(ray);
}

TEST(Strategies, take_few_steps_to_an_ordinary_root) {
  const Ray through{{-3, 0.25, 0.1}, {1, 0, 0}, 0, 6};
  const char* const ball = "x^2 + y^2 + z^2 = 1";
  const auto steps = [&](const char* search) { return cast(ball, search, through).steps; };
  EXPECT_LE(steps("bernstein"), 2);   // both roots; the left one
  EXPECT_LE(steps("polynomial"), 1);  // up to the middle
  EXPECT_LE(steps("segment"), 6);
  EXPECT_LE(steps("newton"), 4);
  EXPECT_GE(steps("stackless"), 15);
}

// A product of x - r and of what is positive. Where the first root is simple and another one is not near it, it is
// found; whatever they are, no answer is wrong.
class RandomRoots {
 public:
  explicit RandomRoots(Random& random) {
    const int count = 1 + static_cast<int>(random.below(6));
    for (int i = 0; i < count; ++i) {
      const bool again = !roots_.empty() && random.one_in(4);
      const double apart = again ? std::exp2(-static_cast<double>(random.below(30))) - 0x1p-29 : 0;
      roots_.push_back(again ? std::min(roots_.back() + apart, 0.95) : random.between(0.05, 0.95));
      source_ += fmt::format("{}(x - {})", i == 0 ? "" : "*", roots_.back());
    }
    if (random.one_in(2)) source_ += "*(x^2 - x + 0.26)";
    source_ += " + 0*y";
    std::ranges::sort(roots_);
  }

  bool is_easy() const { return roots_.size() < 2 || roots_[1] - roots_[0] > 0.01; }
  std::string mistake(const Answer& answer) const {
    if (answer.verdict == verdict_undecided) return "";
    if (answer.verdict == verdict_miss) return fmt::format("missed {}: {}", roots_[0], source_);
    std::size_t close = 0;  // certified: an odd number of roots closer together than is told apart
    bool crosses = false;
    for (std::size_t i = 0; i < roots_.size() && roots_[i] - roots_[0] <= 2e-5; ++i) {
      ++close;
      const bool last_of_equals = i + 1 == roots_.size() || roots_[i + 1] > roots_[i];
      crosses = crosses || (last_of_equals && close % 2 == 1);
    }
    if (!crosses || std::abs(answer.t - roots_[0]) > 2e-5)
      return fmt::format("hit {}, not {}: {}", answer.t, roots_[0], source_);
    return "";
  }
  const std::string& source() const { return source_; }

 private:
  std::vector<double> roots_;
  std::string source_;
};

TEST(Strategies, find_the_first_of_random_roots) {
  for (const Search& search : searches()) {
    Random random(0x2007);
    int easy = 0, decided = 0;
    for (std::size_t i = 0; i < test::effort(120); ++i) {
      const RandomRoots f(random);
      for (const Type type : {f32, f64}) {
        const Answer answer = cast(f.source(), search.name.data(), along_x, type);
        EXPECT_EQ(f.mistake(answer), "") << search.name;
        if (!f.is_easy()) continue;
        ++easy;
        decided += answer.verdict != verdict_undecided;
      }
    }
    EXPECT_GT(easy, test::sanitized ? 10 : 100);
    EXPECT_GT(decided, 0.95 * easy) << search.name;
  }
}

}  // namespace
}  // namespace imp::test
