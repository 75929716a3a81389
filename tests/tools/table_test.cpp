// imp eval, imp cast and imp check: columns, numbers, verdicts, and errors that point at the text.
#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include "tests/support/command.h"

namespace imp {
namespace {

using test::CommandAnswer;
using test::Folder;

const std::string growing_ball =
    "param r = 1 in [0.5, 2]\n"
    "time u = 0\n"
    "surface ball: x^2 + y^2 + z^2 = r^2 + u\n";

CommandAnswer eval(const std::string& program, const std::string& table, std::vector<std::string> more = {},
                   const std::string& text = growing_ball) {
  const Folder folder;
  std::vector<std::string> words{"eval", folder.write("s.imp", text), "--program=" + program, "--points",
                                 "-"};
  words.insert(words.end(), more.begin(), more.end());
  return test::imp(words, table);
}

TEST(Eval, appends_the_columns_of_its_program) {
  EXPECT_EQ(eval("f", "x,y,z\n1,2,3\n").out, "x,y,z,f\n1,2,3,13\n");
  EXPECT_EQ(eval("gradient", "x,y,z\n1,2,3\n").out, "x,y,z,f,fx,fy,fz\n1,2,3,13,2,4,6\n");
  EXPECT_EQ(eval("hessian", "x,y,z\n1,2,3\n").out,
            "x,y,z,f,fx,fy,fz,fxx,fxy,fxz,fyy,fyz,fzz\n1,2,3,13,2,4,6,2,0,0,2,0,2\n");
  EXPECT_EQ(eval("interval", "xlo,xhi,ylo,yhi,zlo,zhi\n-1,2,0,1,0,1\n").out,
            "xlo,xhi,ylo,yhi,zlo,zhi,lo,hi,defined\n-1,2,0,1,0,1,-1,5,1\n");
}

TEST(Eval, passes_cells_through_as_they_stand) {
  EXPECT_EQ(eval("f", "name, z ,y,x\r\n\"a, \"\"b\"\"\", 3.0,+2,0x1p0\r\n\r\nü,3,2,\"1\"").out,
            "name, z ,y,x,f\n\"a, \"\"b\"\"\", 3.0,+2,0x1p0,13\nü,3,2,\"1\",13\n");
  EXPECT_EQ(eval("f", "x,y,z\n").out, "x,y,z,f\n");
}

TEST(Eval, columns_set_uniforms) {
  EXPECT_EQ(eval("f", "x,y,z,u,r\n0,0,0,1,0.5\n0,0,0,2,1\n").out,
            "x,y,z,u,r,f\n0,0,0,1,0.5,-1.25\n0,0,0,2,1,-3\n");
  EXPECT_EQ(eval("f", "x,y,z,u\n0,0,0,1\n", {"-D", "r=2", "--time=7"}).out, "x,y,z,u,f\n0,0,0,1,-5\n");
  EXPECT_EQ(eval("interval", "xlo,xhi,ylo,yhi,zlo,zhi,rlo,rhi\n0,0,0,0,0,0,1,2\n").out,
            "xlo,xhi,ylo,yhi,zlo,zhi,rlo,rhi,lo,hi,defined\n0,0,0,0,0,0,1,2,-4,-1,1\n");
  EXPECT_EQ(eval("interval", "xlo,xhi,ylo,yhi,zlo,zhi,r\n0,0,0,0,0,0,2\n").out,
            "xlo,xhi,ylo,yhi,zlo,zhi,r,lo,hi,defined\n0,0,0,0,0,0,2,-4,-4,1\n");
}

TEST(Eval, numbers_are_text_that_reads_back) {
  EXPECT_EQ(eval("f", "x,y,z\ninf,0,0\nnan,0,0\n1e200,0,0\n0.1,0,0\n", {"--precision=double"}, "x = 0").out,
            "x,y,z,f\ninf,0,0,inf\nnan,0,0,nan\n1e200,0,0,1e+200\n0.1,0,0,0.1\n");
  EXPECT_EQ(
      eval("interval", "xlo,xhi,ylo,yhi,zlo,zhi\n2,1,0,0,0,0\nnan,1,0,0,0,0\n-inf,0,0,0,0,0\n", {}, "x = 0")
          .out,
      "xlo,xhi,ylo,yhi,zlo,zhi,lo,hi,defined\n2,1,0,0,0,0,inf,-inf,0\nnan,1,0,0,0,0,inf,-inf,0\n"
      "-inf,0,0,0,0,0,-inf,0,1\n");
}

// An input error, whose first line ends with `message`, at standard input's `place`.
void expect_error(const CommandAnswer& answer, const std::string& place, const std::string& message) {
  EXPECT_EQ(answer.exit, 1);
  EXPECT_EQ(answer.out, "");
  EXPECT_EQ(answer.err.substr(0, answer.err.find('\n')), "<stdin>:" + place + ": error: " + message);
}

TEST(Eval, points_at_what_is_wrong_in_the_table) {
  expect_error(eval("f", ""), "1:1", "an empty table; its first line must name the columns");
  expect_error(eval("f", "x,y\n1,2\n"), "1:1", "no column 'z'; there must be x,y,z");
  expect_error(eval("interval", "x,y,z\n1,2,3\n"), "1:1",
               "no column 'xlo'; there must be xlo,xhi,ylo,yhi,zlo,zhi");
  expect_error(eval("f", "x,y,z\n1,2,3\n1,2\n"), "3:1", "2 cells in a row of a table with 3 columns");
  expect_error(eval("f", "x,y,z\n1,2,3,4\n"), "2:7", "4 cells in a row of a table with 3 columns");
  expect_error(eval("f", "x,y,z\n1,2,2x\n"), "2:5", "'2x' in column 'z' is no number that a double holds");
  expect_error(eval("f", "x,y,z\n1,,3\n"), "2:3", "column 'y' needs a number here");
  expect_error(eval("f", "x,y,z,x\n1,2,3,4\n"), "1:7", "a second column 'x'");
  expect_error(eval("interval", "xlo,xhi,ylo,yhi,zlo,zhi,rlo\n"), "1:25", "no column 'rhi' beside this one");
  EXPECT_EQ(eval("f", "x,y,z,note\n1,2,3,x\n").exit, 0);
}

TEST(Eval, wants_one_surface) {
  const std::string two = "surface ball: x = 1\nsurface plane: x = 2\n";
  EXPECT_EQ(eval("f", "x,y,z\n0,0,0\n", {}, two).err,
            "error: the file has several surfaces; choose one with --surface: ball, plane\n");
  EXPECT_EQ(eval("f", "x,y,z\n0,0,0\n", {"--surface=plane"}, two).out, "x,y,z,f\n0,0,0,-2\n");
  const CommandAnswer wrong = eval("f", "x,y,z\n0,0,0\n", {"--surface=plain"}, two);
  EXPECT_EQ(wrong.exit, 1);
  EXPECT_EQ(wrong.err, "error: no surface 'plain'; did you mean 'plane'?\n");
}

// x^2 - x over [0, 1] by each: the contract is the natural extension where no form is named. By that
// [0, 1] - [0, 1]; by the mean value -1/4 + [-1, 1] [-1/2, 1/2]; by Bernstein the hull of 0, -1/2, 0.
TEST(Eval, encloses_by_the_form_that_is_named) {
  const std::string box = "xlo,xhi,ylo,yhi,zlo,zhi\n0,1,0,0,0,0\n", text = "x^2 - x = 0";
  const auto bounds = [&](const std::string& program, std::vector<std::string> more) {
    const CommandAnswer answer = eval(program, box, std::move(more), text);
    EXPECT_EQ(answer.exit, 0) << answer.err;
    return answer.out.substr(answer.out.find("0,1,0,0,0,0,") + 12);
  };
  const std::string natural = bounds("interval", {});
  EXPECT_EQ(natural, "-1,1,1\n");
  EXPECT_EQ(bounds("interval", {"--inclusion=ia"}), natural);
  EXPECT_EQ(bounds("interval", {"--inclusion=bernstein"}), "-0.5,0,1\n");
  EXPECT_EQ(bounds("interval", {"--inclusion=mean-value"}), "-0.75,0.25,1\n");
  EXPECT_EQ(bounds("mean-value", {"--inclusion=bernstein"}), bounds("mean-value", {}));
}

TEST(Eval, says_where_a_form_has_no_rule) {
  const CommandAnswer answer =
      eval("interval", "xlo,xhi,ylo,yhi,zlo,zhi\n0,1,0,0,0,0\n", {"--inclusion=bernstein"}, "y + sin(x) = 0");
  EXPECT_EQ(answer.exit, 1);
  EXPECT_NE(answer.err.find("s.imp:1:5: error: 'sin' makes this no polynomial in x, y, z; "
                            "use --inclusion=auto\n"),
            std::string::npos)
      << answer.err;
}

TEST(Eval, reports_on_request) {
  const auto json = nlohmann::json::parse(eval("f", "x,y,z\n0,0,0\n", {"--stats=json", "--timings"}).err);
  EXPECT_EQ(json["points"], 1);
  EXPECT_EQ(json["backend"], "llvm");
  EXPECT_TRUE(json["timings"].contains("parse"));
  EXPECT_NE(eval("f", "x,y,z\n0,0,0\n", {"--stats"}).err.find("1 points in"), std::string::npos);
}

TEST(Eval, is_quick_for_many_rows) {
  std::string table = "x,y,z\n";
  for (int i = 0; i < 100'000; ++i) table += "0.25,-1.5,0.123456789012345\n";
  const CommandAnswer answer = eval("f", table);
  EXPECT_EQ(answer.exit, 0);
  EXPECT_EQ(std::ranges::count(answer.out, '\n'), 100'001);
}

CommandAnswer cast(const std::string& text, const std::string& rows, std::vector<std::string> more = {}) {
  const Folder folder;
  std::vector<std::string> words{"cast", "-", "--rays",
                                 folder.write("r.csv", "ox,oy,oz,dx,dy,dz,tmin,tmax" + rows)};
  words.insert(words.end(), more.begin(), more.end());
  return test::imp(words, text);
}

TEST(Cast, answers_every_ray) {
  const CommandAnswer answer =
      cast(growing_ball, "\n0,0,3,0,0,-1,0,10\n3,0,3,0,0,-1,0,10\n", {"--precision=double", "--stats=json"});
  std::istringstream lines(answer.out);
  std::string header, hit, miss;
  std::getline(lines, header);
  std::getline(lines, hit);
  std::getline(lines, miss);
  EXPECT_EQ(header, "ox,oy,oz,dx,dy,dz,tmin,tmax,verdict,t,nx,ny,nz,steps");
  EXPECT_TRUE(hit.starts_with("0,0,3,0,0,-1,0,10,hit,")) << hit;
  EXPECT_NEAR(std::stod(hit.substr(std::string("0,0,3,0,0,-1,0,10,hit,").size())), 2, 1e-4);
  EXPECT_TRUE(hit.find(",0,0,1,") != std::string::npos || hit.find(",0,0,0.99999") != std::string::npos)
      << hit;
  EXPECT_TRUE(miss.starts_with("3,0,3,0,0,-1,0,10,miss,,,,,")) << miss;
  const auto stats = nlohmann::json::parse(answer.err);
  EXPECT_EQ(stats["rays"], 2);
  EXPECT_EQ(stats["hit"], 1);
  EXPECT_EQ(stats["miss"], 1);
  EXPECT_EQ(stats["search"], "isolate");
}

TEST(Cast, columns_set_uniforms) {
  const CommandAnswer answer = cast(growing_ball, ",r\n0,0,3,0,0,-1,0,1.5,1\n0,0,3,0,0,-1,0,1.5,2\n");
  EXPECT_NE(answer.out.find(",1,miss,"), std::string::npos) << answer.out;
  EXPECT_NE(answer.out.find(",2,hit,"), std::string::npos) << answer.out;
}

TEST(Check, is_quiet_about_what_is_right) {
  const CommandAnswer answer = test::imp({"check", "-"}, growing_ball);
  EXPECT_EQ(answer.exit, 0);
  EXPECT_EQ(answer.out + answer.err, "");
  EXPECT_EQ(test::imp({"check", "-", "--json"}, growing_ball).out, "[]\n");
}

TEST(Check, tells_what_is_wrong) {
  const std::string wrong = "surface ball: x + foo = 1\n";
  const CommandAnswer answer = test::imp({"check", "-"}, wrong);
  EXPECT_EQ(answer.exit, 1);
  EXPECT_TRUE(answer.err.starts_with("<stdin>:1:19: error: unknown name 'foo'")) << answer.err;

  const Folder folder;
  const CommandAnswer json = test::imp({"check", "--json", folder / "no.imp", folder.write("s.imp", wrong)});
  EXPECT_EQ(json.exit, 1);
  EXPECT_EQ(json.err, "");
  const auto all = nlohmann::json::parse(json.out);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0]["file"], folder / "no.imp");
  EXPECT_TRUE(all[0]["line"].is_null());
  EXPECT_EQ(all[1]["file"], folder / "s.imp");
  EXPECT_EQ(all[1]["line"], 1);
  EXPECT_EQ(all[1]["column"], 19);
  EXPECT_EQ(all[1]["end_column"], 22);
  EXPECT_EQ(all[1]["severity"], "error");
  EXPECT_TRUE(all[1]["message"].get<std::string>().starts_with("unknown name 'foo'"));
}

}  // namespace
}  // namespace imp
