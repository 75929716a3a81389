// imp inspect: Programs as text, what passes do to them, and code for any processor.
#include <algorithm>
#include <sstream>

#include <gtest/gtest.h>

#include "ir/text.h"
#include "passes/pass.h"
#include "passes/surface_passes.h"
#include "tests/support/command.h"
#include "tests/support/golden.h"

namespace imp {
namespace {

using test::CommandAnswer;
using test::expect_usage_error;

const std::string torus =
    "param a = 0.5 in [0.25, 1]\n"
    "ring = sqrt(x^2 + y^2) - 1\n"
    "surface torus: ring^2 + z^2 = a^2\n";

CommandAnswer inspect(std::vector<std::string> words, const std::string& text = torus) {
  words.insert(words.begin(), {"inspect", "-"});
  return test::imp(words, text);
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

// How often a kernel goes through a pass.
std::size_t runs_of(std::string_view pass) {
  return static_cast<std::size_t>(std::ranges::count(kernel_passes(), pass, &Pass::name));
}

TEST(InspectGolden, shows_a_program_with_the_names_of_its_author) {
  const CommandAnswer answer = inspect({});
  EXPECT_EQ(answer.exit, 0);
  EXPECT_EQ(answer.err, "");
  test::expect_golden("inspect.ir", answer.out);
}

// What is shown is a Program to every reader, counts included: they are comments.
TEST(Inspect, shows_every_program) {
  for (const std::string program : {"f", "gradient", "hessian", "interval", "cast", "pixel"})
    for (const std::string precision : {"float", "double"}) {
      const CommandAnswer answer = inspect({"--program", program, "--precision", precision});
      ASSERT_EQ(answer.exit, 0) << answer.err;
      Diagnostics diagnostics;
      const auto shown = parse_program(answer.out, program, diagnostics);
      ASSERT_TRUE(shown) << to_text(diagnostics);
      constexpr std::size_t phases = 3;  // of the search, of refinement, and the one that confirms the place
      EXPECT_EQ(shown->phases.size(), program == "cast" || program == "pixel" ? phases : 0U);
      EXPECT_EQ(to_text(*shown), inspect({"--emit=ir", "--program", program, "--precision", precision}).out);
      EXPECT_NE(answer.out.find("\n# total "), std::string::npos);
    }
}

TEST(Inspect, says_how_rays_are_searched) {
  EXPECT_NE(inspect({"--program=cast"}).out.find("\n# search isolate, inclusion auto (auto: "),
            std::string::npos);
  EXPECT_NE(inspect({"--program=pixel", "--search=stackless", "--inclusion=ia"},
                    "surface a: x = 0\nsurface b: y = 0\n")
                .out.find("\n# a: search stackless, inclusion ia\n# b: search stackless, inclusion ia\n"),
            std::string::npos);
  EXPECT_EQ(inspect({"--program=f"}).out.find("# search"), std::string::npos);
}

TEST(Inspect, shows_what_every_pass_changed) {
  const std::string out = inspect({"--passes", "--program=gradient"}).out;
  EXPECT_TRUE(out.starts_with("== as written\nprogram torus\n")) << out;
  EXPECT_EQ(count(out, "\n== before the passes of kernels\nprogram torus\n"), 1u);
  EXPECT_NE(out.find("powi"), std::string::npos);
  EXPECT_EQ(out.find("powi", out.find("\n== powers\n")), std::string::npos);
  // The table has a row for every pass; a Program is shown after each that changed it.
  const std::string table = out.substr(out.find("\n# pass "));
  for (const Pass& pass : kernel_passes())
    EXPECT_EQ(count(table, "\n# " + std::string(pass.name) + " "), runs_of(pass.name)) << pass.name;
  EXPECT_EQ(count(out, "\n== ") + count(table, "unchanged\n"),
            1 + surface_passes().size() + kernel_passes().size());
}

// What the domain decides, of pictures alone.
TEST(Inspect, shows_what_the_domain_makes_of_f) {
  const std::string sheet = "sqrt(abs(z + 5)) = max(x, -4)\n";
  const std::string out = inspect({"--passes", "--program=pixel"}, sheet).out;
  const std::size_t begin = out.find("\n== specialize\n"), end = out.find("\n== ", begin + 1);
  ASSERT_NE(begin, std::string::npos);
  EXPECT_EQ(out.substr(begin, end - begin).find("max"), std::string::npos);
  for (const std::string program : {"f", "interval", "cast"})
    EXPECT_EQ(inspect({"--passes", "--program", program}, sheet).out.find("specialize"), std::string::npos);
}

TEST(Inspect, shows_what_economisation_saves) {
  const std::string f = "x + x^3/1e3 + x^12/1e12 = y\n";
  const std::vector<std::string> words{"--program=pixel", "--search=stackless"};
  const std::string before = inspect(words, f).out;
  EXPECT_NE(inspect({words[0], words[1], "--economize=1e-4"}, f).out, before);
  EXPECT_EQ(inspect({words[0], words[1], "--economize=1e-30"}, f).out, before);
}

TEST(Inspect, shows_a_program_after_one_pass) {
  for (const Pass& pass : kernel_passes()) {
    const std::string out = inspect({"--print-after", std::string(pass.name)}).out;
    EXPECT_TRUE(out.starts_with("== " + std::string(pass.name) + "\nprogram torus\n")) << out;
    EXPECT_EQ(count(out, "\nend\n"), runs_of(pass.name));
  }
  EXPECT_TRUE(inspect({"--rounding=nearest", "--program=interval", "--print-after=round-to-nearest"})
                  .out.starts_with("== round-to-nearest\n"));
}

TEST(Inspect, knows_the_passes_that_are_listed) {
  std::istringstream lines(test::imp({"list", "passes"}).out);
  std::size_t passes = 0;
  for (std::string line; std::getline(lines, line); ++passes) {
    const std::string name = line.substr(0, line.find(' '));
    EXPECT_EQ(inspect({"--print-after", name}).exit, 0) << name;
  }
  EXPECT_GE(passes, kernel_passes().size());
}

TEST(Inspect, emits_code_for_any_processor) {
  EXPECT_NE(inspect({"--emit=ll", "--target=avx2"}).out.find("define "), std::string::npos);
  const std::string wide = inspect({"--emit=asm", "--target=avx512"}).out;
  const std::string narrow = inspect({"--emit=asm", "--target=sse4.1"}).out;
  EXPECT_NE(wide.find("%zmm"), std::string::npos);
  EXPECT_EQ(narrow.find("%ymm"), std::string::npos);
  EXPECT_NE(narrow.find("sqrtps"), std::string::npos);
}

TEST(Inspect, refuses_by_name) {
  expect_usage_error(inspect({"--print-after", "pwers"}),
                     "--print-after: unknown 'pwers'; did you mean 'powers'?");
  expect_usage_error(inspect({"--print-after", "all"}), "--print-after: unknown 'all'; there are ");
  expect_usage_error(inspect({"--emit=dot"}), "--emit: 'dot' is not there yet; there are ir, ll, asm");
  expect_usage_error(inspect({"--program=afine"}), "--program: unknown 'afine'; did you mean 'affine'?");
  expect_usage_error(inspect({"--emit=asm", "--passes"}), "--emit: shows what comes after the passes");
  expect_usage_error(inspect({"--stats"}), "--stats: nothing is evaluated here");

  EXPECT_EQ(test::imp({"inspect", "no.imp"}).err, "error: cannot read 'no.imp': No such file or directory\n");
  const CommandAnswer unknown = inspect({"-D", "b=1"});
  EXPECT_EQ(unknown.exit, 1);
  EXPECT_NE(unknown.err.find("'b'"), std::string::npos) << unknown.err;
  EXPECT_NE(inspect({}, "surface a: x = 0\nsurface b: y = 0\n").err.find("--surface: a, b"),
            std::string::npos);
  EXPECT_EQ(inspect({"--program=pixel"}, "surface a: x = 0\nsurface b: y = 0\n").exit, 0);
}

}  // namespace
}  // namespace imp
