// Whatever the text, parsing ends with a Program or with errors that point at the text.
#include <gtest/gtest.h>

#include "ir/text.h"
#include "ir/verify.h"
#include "tests/support/random_program.h"

namespace imp {
namespace {

// The first line of each error.
std::string errors_of(const std::string& text) {
  Diagnostics diagnostics;
  EXPECT_FALSE(parse_program(text, "t", diagnostics).has_value()) << text;
  std::string all;
  for (const Diagnostic& d : diagnostics.all()) {
    if (d.span.valid()) {
      const Position at = position(diagnostics.sources, d.span);
      all += std::to_string(at.line) + ':' + std::to_string(at.column) + ": ";
    }
    all += d.message + '\n';
  }
  return all;
}

struct Malformed {
  const char* lines;  // of a program with the inputs x (f32), d (f64) and c (truth), from line 5
  const char* errors;
};

class ParseErrors : public testing::TestWithParam<Malformed> {};

TEST_P(ParseErrors, point_at_the_text) {
  const std::string head = "program p\ninput ray x: f32\ninput ray d: f64\ninput ray c: truth\n";
  EXPECT_EQ(errors_of(head + GetParam().lines + "\nend\n"), GetParam().errors) << GetParam().lines;
}

INSTANTIATE_TEST_SUITE_P(
    , ParseErrors,
    testing::ValuesIn(std::vector<Malformed>{
        {"%1 = add %x %z", "5:13: unknown name '%z'\n"},
        {"%radius = mul %x %x\n%1 = add %x %radus", "6:13: unknown name '%radus'; did you mean 'radius'?\n"},
        {"%1 = ad %x %x", "5:6: unknown op 'ad'; did you mean 'add'?\n"},
        {"%1 = constant", "5:6: unknown op 'constant'\n"},
        {"%1 = add %x", "5:6: 'add' takes 2 operands, not 1\n"},
        {"%1 = neg %x %x", "5:6: 'neg' takes 1 operand, not 2\n"},
        {"%1 = add %x %d", "5:6: 'add' does not take (f32, f64)\n"},
        {"%1 = add %x 0.5", "5:6: 'add' does not take (f32, f64)\n"},
        {"%1 = not %x", "5:6: 'not' does not take (f32)\n"},
        {"%1 = widen %d", "5:6: 'widen' does not take (f64)\n"},
        {"%1 = add %x 1e999f", "5:13: '1e999f' is no number, or beyond the range of its type\n"},
        {"%1 = add %x 1.2.3", "5:13: '1.2.3' is no number, or beyond the range of its type\n"},
        {"%1 = add %x", "5:6: 'add' takes 2 operands, not 1\n"},
        {"%1 = powi %x %x", "5:6: the exponent of 'powi' is a constant integer of magnitude at most 2^20\n"},
        {"%1 = powi %x 0.5f",
         "5:6: the exponent of 'powi' is a constant integer of magnitude at most 2^20\n"},
        {"%1 = powi 2f 1e+30f",
         "5:6: the exponent of 'powi' is a constant integer of magnitude at most 2^20\n"},
        {"%1 = chebyshev %x %x 0f", "5:6: the degree of 'chebyshev' is a constant integer from 0 to 2^20\n"},
        {"%1 = chebyshev 2f 3f 4f",
         "5:6: the order of 'chebyshev' is a constant integer from 0 to the degree, and at most 8\n"},
        {"%x = add %x %x", "5:1: '%x' is already there\n"},
        {"%1 = neg %x\n%1 = neg %x", "6:1: '%1' is already there\n"},
        {"input ray x: f32", "5:11: '%x' is already there\n"},
        {"%1 neg %x", "5:4: expected '=', not 'neg'\n"},
        {"%1 =", "5:5: expected an op, not the end of the line\n"},
        {"% = neg %x", "5:3: expected the name of the node, not '='\n"},
        {"%1 = neg x", "5:10: 'x' is no constant; a name is written %x\n"},
        {"%1 = neg %x ]", "5:13: expected an operand: %name or a constant, not ']'\n"},
        {"output y %x", "5:10: expected '=', not '%'\n"},
        {"output y = %x %x", "5:15: expected the end of the line, not '%'\n"},
        {"output = %x", "5:8: expected the name of the output, not '='\n"},
        {"output \"y = %x", "5:8: expected the name of the output; this quote is not closed\n"},
        {"output \"\\q\" = %x", "5:8: expected the name of the output, not a quoted name\n"},
        {"input x: f32", "5:7: expected 'frame', 'cell' or 'ray', not 'x'\n"},
        {"input ray y", "5:12: expected ':', not the end of the line\n"},
        {"input ray y: f16", "5:14: expected a type, like f32, f64, truth or f32[16]\n"},
        {"input cell y: f32[0]", "5:15: expected a type, like f32, f64, truth or f32[16]\n"},
        {"input cell y: f32[4", "5:20: expected ']', not the end of the line\n"},
        {"%t = fill f32 %x", "5:6: 'fill' of f32 does not take (f32)\n"},
        {"%t = fill f32[4] %d", "5:6: 'fill' of f32[4] does not take (f64)\n"},
        {"%1 = call f.y %x", "5:6: 'f' is not among the 'calls' of this program\n"},
        {"calls f", "5:7: no program 'f' comes before this one\n"},
        {"calls", "5:6: expected the name of the program, not the end of the line\n"},
        {"inptu ray y: f32", "5:1: expected a statement; did you mean 'input'?, not 'inptu'\n"},
        {"$", "5:1: expected a statement, not this character\n"},
        {"state t: f32 = %x", "5:1: 'state' outside of a phase\n"},
        {"next t = %x", "5:1: 'next' outside of a phase\n"},
        {"again %c", "5:1: 'again' outside of a phase\n"},
        {"phase a 3\nend", "5:1: a phase without 'again'\n"},
        {"phase a\nagain %c\nend", "5:8: expected the number of steps, not the end of the line\n"},
        {"phase a -3\nagain %c\nend", "5:9: expected the number of steps, not '-3'\n"},
        {"phase a 3\nphase b 3\nagain %c\nend",
         "6:1: a phase within a phase; a call may hold phases of its own\n"},
        {"phase a 3\nstate t: f64 = %x\nnext t = %d\nagain %c\nend\noutput t = %a.t",
         "6:7: the start of 't' is f32, not f64\n"},
        {"phase a 3\nstate t: f32 = %x\nstate t: f32 = %x\nagain %c\nend",
         "7:7: state 't' is already there\n"},
        {"phase a 3\nstate t: f32 = %x\nnext tt = %x\nagain %c\nend", "7:6: no state 'tt' in this phase\n"},
        {"phase a 3\nstate t: f32 = %x\nagain %c\nend\noutput t = %t", "9:12: unknown name '%t'\n"},
        // A wrong line is reported once, and so are not the lines that need it.
        {"%1 = ad %x %x\n%2 = add %1 %x\n%3 = lt %2 %1\noutput y = %3\n%4 = sine %x",
         "5:6: unknown op 'ad'; did you mean 'add'?\n9:6: unknown op 'sine'; did you mean 'sin'?\n"},
        // What only the verifier knows points at the program.
        {"output x = %x\noutput x = %x", "1:1: program 'p' is not legal: two outputs are called 'x'\n"},
        {"phase a 3\nstate t: f32 = %x\n%1 = neg %t\nagain %c\nend\noutput t = %1",
         "1:1: program 'p' is not legal: output 't' uses a state outside of its phase\n"},
        {"phase a 3\nstate t: f32 = %x\nnext t = %d\nagain %c\nend\noutput t = %a.t",
         "1:1: program 'p' is not legal: the next value of 'a.t' is f64, not f32\n"},
        {"input ray \"table\": f32[4]",
         "1:1: program 'p' is not legal: input 'table' is a table of rate ray; a table has rate frame or "
         "cell\n"},
    }));

TEST(Parse, whole_texts) {
  EXPECT_EQ(errors_of(""), "no program in the text\n");
  EXPECT_EQ(errors_of("# nothing\n\n"), "no program in the text\n");
  EXPECT_EQ(errors_of("surface s"), "1:1: expected 'program' or 'stage', not 'surface'\n");
  EXPECT_EQ(errors_of("program p\noutput y = 1f\n"), "1:1: program 'p' has no 'end'\n");
  EXPECT_EQ(errors_of("program p\nprogram q\nend"), "1:1: program 'p' has no 'end'\n");
  EXPECT_EQ(errors_of("program p\nend\nend\n"), "3:1: expected 'program' or 'stage', not 'end'\n");
  EXPECT_EQ(errors_of("program\nend"), "1:8: expected the name of the program, not the end of the line\n");
  EXPECT_EQ(errors_of("stage 1 2 3\nprogram p\nend"), "1:1: a pipeline, where one program is wanted\n");
  EXPECT_EQ(errors_of("stage 1 2\nprogram p\nend"),
            "1:10: expected three numbers of cells: columns, rows, slabs, not the end of the line\n");
  EXPECT_EQ(errors_of("stage 1 0 1\nprogram p\nend"), "1:1: a stage without cells\n");
  EXPECT_EQ(errors_of("stage 1 1 1\n"), "1:1: a stage without a program\n");
}

TEST(Parse, calls) {
  const std::string f = "program f\ninput ray x: f32\n%1 = neg %x\noutput y = %1\nend\n";
  EXPECT_EQ(errors_of(f + "program p\ncalls f\n%1 = call f.z 1f\nend"), "8:6: 'f' has no output 'z'\n");
  EXPECT_EQ(errors_of(f + "program p\ncalls f\n%1 = call f.y 1\nend"), "8:6: 'f' takes (f32), not (f64)\n");
  EXPECT_EQ(errors_of(f + "program p\ncalls f\n%1 = call f.y\nend"), "8:6: 'f' takes (f32), not ()\n");
  EXPECT_EQ(errors_of(f + "program p\ncalls f@2\nend"), "7:7: no program 'f@2' comes before this one\n");
  EXPECT_EQ(errors_of(f + "program p\ncalls f, f\nend"),
            "6:1: program 'p' is not legal: callee 'f' is listed twice\n");
  // The caller of a wrong program is not to blame.
  EXPECT_EQ(errors_of("program f\n%1 = ad 1 2\noutput y = %1\nend\nprogram p\ncalls f\n%1 = call f.y\nend"),
            "2:6: unknown op 'ad'; did you mean 'add'?\n");
}

// Bytes are changed, dropped and doubled in texts that are right.
TEST(Parse, garbage_never_crashes) {
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    test::Random random(seed);
    const Program p = test::random_program(
        seed % 40, {.nodes = 12, .phases = seed % 3, .tables = true, .calls = true, .odd_names = true});
    std::string text = to_text(p);
    for (std::size_t i = 0, n = 1 + random.below(6); i < n; ++i) {
      const std::size_t at = random.below(text.size());
      switch (random.below(4)) {
        case 0:  text[at] = static_cast<char>(random.below(256)); break;
        case 1:  text.erase(at, 1 + random.below(20)); break;
        case 2:  text.insert(at, text.substr(random.below(text.size()), random.below(30))); break;
        default: text[at] = "%.:=[]@,\"\\#\n -0f"[random.below(16)]; break;
      }
      if (text.empty()) text = "x";
    }
    Diagnostics diagnostics;
    const auto back = parse_program(text, "garbage", diagnostics);
    EXPECT_NE(back.has_value(), diagnostics.has_errors());
    if (back) { EXPECT_EQ(verify(*back), ""); }
    static_cast<void>(to_text(diagnostics));
  }
}

}  // namespace
}  // namespace imp
