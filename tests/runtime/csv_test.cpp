// Tables as text: numbers that read back, cells as they stand, errors that point at them.
#include "runtime/csv.h"

#include <bit>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace imp {
namespace {

TEST(Csv, numbers_are_read) {
  const std::pair<const char*, double> numbers[] = {
      {"1", 1},         {" +1.5 ", 1.5},   {"-2.5e-3", -2.5e-3}, {"0x1p-3", 0.125},
      {"-0x1.8P1", -3}, {"inf", INFINITY}, {"-inf", -INFINITY},  {"Infinity", INFINITY},
      {".5", 0.5},      {"5.", 5},         {"1e-999", 0},        {"4.9e-324", 5e-324},
  };
  for (const auto& [text, value] : numbers) EXPECT_EQ(read_number(text), value) << text;
  EXPECT_TRUE(std::isnan(read_number("nan").value()));
  EXPECT_TRUE(std::signbit(read_number("-0").value()));
  for (const char* text : {"", " ", "+", "-", "+-1", "--1", "1 2", "1,5", "0x", "0x-1", "1e", "abc", "1e999",
                           "-1e999", "0x1p2000", "1x"})
    EXPECT_EQ(read_number(text), std::nullopt) << text;
}

TEST(Csv, numbers_read_back) {
  std::mt19937_64 rng(7);
  for (int i = 0; i < 100'000; ++i) {
    const double value = std::bit_cast<double>(rng());
    const double back = read_number(number_text(value)).value();
    if (std::isnan(value))
      EXPECT_TRUE(std::isnan(back));
    else
      ASSERT_EQ(std::bit_cast<std::uint64_t>(back), std::bit_cast<std::uint64_t>(value))
          << number_text(value);
  }
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(number_text(-0.0), "-0");
  EXPECT_EQ(number_text(1e30), "1e+30");
  EXPECT_EQ(number_text(-INFINITY), "-inf");
  EXPECT_EQ(number_text(-NAN), "nan");
}

std::string errors_in(const std::string& text, std::size_t column = 0) {
  Diagnostics diagnostics;
  const auto csv = Csv::parse(diagnostics.sources.add("t.csv", text), diagnostics);
  if (csv) csv->numbers(column, diagnostics);
  std::string places;
  for (const Diagnostic& each : diagnostics.all()) {
    const auto [line, at] = position(diagnostics.sources, each.span);
    places += (places.empty() ? "" : " ") + std::to_string(line) + ":" + std::to_string(at);
  }
  return places;
}

TEST(Csv, cells_stand_as_they_are) {
  Diagnostics diagnostics;
  const auto csv = Csv::parse(
      diagnostics.sources.add("t.csv", "\xEF\xBB\xBF x , \"the \"\"y\"\"\"\r\n 1 ,\"a,\nb\"\r\n\r\n\"2\",c"),
      diagnostics);
  ASSERT_TRUE(csv) << to_text(diagnostics);
  EXPECT_EQ(csv->header_text(), " x , \"the \"\"y\"\"\"");
  ASSERT_EQ(csv->names().size(), 2u);
  EXPECT_EQ(csv->names()[0], "x");
  EXPECT_EQ(csv->names()[1], "the \"y\"");
  ASSERT_EQ(csv->rows(), 2u);
  EXPECT_EQ(csv->row_text(0), " 1 ,\"a,\nb\"");
  EXPECT_EQ(csv->row_text(1), "\"2\",c");
  EXPECT_EQ(csv->numbers(0, diagnostics), (std::vector<double>{1, 2}));
}

TEST(Csv, errors_point_at_cells) {
  EXPECT_EQ(errors_in("x,y\n1,2\n3,4\n"), "");
  EXPECT_EQ(errors_in("x,y"), "");
  EXPECT_EQ(errors_in(""), "1:1");
  EXPECT_EQ(errors_in("\n\n"), "1:1");
  EXPECT_EQ(errors_in("x,y\n1\n1,2,3\n"), "2:1 3:5");
  EXPECT_EQ(errors_in("x,y\na,2\n1,2\n , 3"), "2:1 4:2");
  EXPECT_EQ(errors_in("x,y\n1, q \n", 1), "2:4");
  EXPECT_EQ(errors_in("x,y\n1,\"2\n"), "2:3");
  EXPECT_EQ(errors_in("x,y\n1,\"2\" 3\n"), "2:7");
}

TEST(Csv, a_column_stands_once) {
  Diagnostics diagnostics;
  const auto csv = Csv::parse(diagnostics.sources.add("t.csv", "x,y,x\n"), diagnostics);
  ASSERT_TRUE(csv);
  EXPECT_EQ(csv->column("y", diagnostics), 1u);
  EXPECT_EQ(csv->column("z", diagnostics), std::nullopt);
  EXPECT_FALSE(diagnostics.has_errors());
  csv->column("x", diagnostics);
  EXPECT_EQ(diagnostics.errors(), 1u);
}

}  // namespace
}  // namespace imp
