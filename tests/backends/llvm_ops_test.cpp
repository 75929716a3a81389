// Every op means on every target what the last column of ir/ops.def says, bit for bit.
#include <array>
#include <numbers>

#include "ir/meaning.h"
#include "ir/rounding.h"
#include "tests/backends/llvm_support.h"

namespace imp {
namespace {

template <class T>
std::vector<double> interesting_values() {
  using Limits = std::numeric_limits<T>;
  const auto pi = std::numbers::pi_v<T>;
  const auto digits = static_cast<T>(Limits::digits);
  const std::array positive{T(0),
                            T(1),
                            T(0.1),
                            T(0.5),
                            T(2.5),
                            T(3),
                            T(7),
                            T(100.7),
                            pi,
                            pi / 2,
                            1000 * pi,
                            Limits::denorm_min(),
                            5 * Limits::denorm_min(),
                            Limits::min() / 2,
                            std::nextafter(Limits::min(), T(0)),
                            Limits::min(),
                            Limits::epsilon(),
                            std::nextafter(T(1), T(2)),
                            std::nextafter(T(1), T(0)),
                            Limits::max(),
                            Limits::max() / 2,
                            T(1e30),
                            T(1e-30),
                            T(Limits::max_exponent),
                            1 + T(Limits::max_exponent),
                            -T(Limits::min_exponent),
                            digits - T(Limits::min_exponent),
                            digits + 1 - T(Limits::min_exponent),
                            T(1.5) * digits - T(Limits::min_exponent),
                            T(2200),
                            T(5000),
                            T(8388609.5),
                            Limits::infinity(),
                            Limits::quiet_NaN()};
  std::vector<double> values;
  for (const auto value : positive)
    for (const double sign : {1.0, -1.0}) values.push_back(static_cast<T>(sign * static_cast<double>(value)));
  return values;
}

std::vector<double> few_values() {
  return {0.0,
          -0.0,
          1,
          -1,
          3,
          -0.1f,
          1e30f,
          -1e30f,
          1e-30f,
          1e-38f,
          -1e-44f,
          7.5f,
          1.0000001f,
          0.33333334f,
          std::numeric_limits<double>::infinity(),
          -std::numeric_limits<double>::infinity(),
          std::numeric_limits<double>::quiet_NaN()};
}

// All tuples of operands, one column an operand.
std::vector<Column> tuples(int arity, const std::vector<double>& values) {
  std::vector<Column> columns(static_cast<std::size_t>(arity));
  std::size_t count = 1;
  for (int i = 0; i < arity; ++i) count *= values.size();
  for (std::size_t row = 0; row < count; ++row) {
    std::size_t rest = row;
    for (Column& column : columns) {
      column.push_back(values[rest % values.size()]);
      rest /= values.size();
    }
  }
  return columns;
}

// The op over inputs of these types. In an upward Program plain ops round upward too.
Program of_op(Op op, std::span<const Type> types, Rate rate, bool upward) {
  Program program;
  program.name = info(op).name;
  std::vector<Id> args;
  for (std::size_t i = 0; i < types.size(); ++i)
    args.push_back(add_input(program, std::string(1, static_cast<char>('a' + i)), types[i], rate));
  program.outputs.push_back({"result", program.graph.add(op, args)});
  if (upward) {
    const Id three = program.graph.constant(types[0], 3);
    program.outputs.push_back({"upward", program.graph.add(Op::add_up, {args[0], three})});
  }
  return program;
}

template <class T>
double meaning_of(Op op, bool fuses, double a, double b, double c) {
  const auto x = static_cast<T>(a), y = static_cast<T>(b), z = static_cast<T>(c);
  if ((op == Op::fma || op == Op::fma_up) && !fuses) {
    const volatile T product = x * y;
    return product + z;
  }
  if (info(op).kind == OpKind::compare) return meaning::truth<T>(op, x, y) ? 1 : 0;
  return meaning::real<T>(op, x, y, z);
}

bool fuses(const CpuTarget& target) { return target.register_bits > 128; }

template <class T>
void check_real(Op op, Type type, bool upward) {
  const int arity = info(op).arity;
  const auto columns = tuples(arity, arity == 3 ? few_values() : interesting_values<T>());
  const std::vector<Type> types(columns.size(), type);
  const Program program = of_op(op, types, Rate::ray, upward);
  const std::size_t size = columns[0].size();
  for (const CpuTarget& target : targets_here()) {
    Column expected;
    {
      const RoundingMode mode(upward ? FE_UPWARD : FE_TONEAREST);
      const auto at = [&](std::size_t i, std::size_t row) {
        return i < columns.size() ? columns[i][row] : 0.0;
      };
      for (std::size_t row = 0; row < size; ++row)
        expected.push_back(meaning_of<T>(op, fuses(target), at(0, row), at(1, row), at(2, row)));
    }
    const auto got = run(*compiled(program, target), columns, size);
    for (std::size_t row = 0; row < size; ++row) {
      std::string operands;
      for (const Column& column : columns) operands += " " + testing::PrintToString(column[row]);
      ASSERT_TRUE(same(got[0][row], expected[row]))
          << target.name << (upward ? " upward " : " ") << info(op).name << " " << to_text(type) << operands
          << ": " << got[0][row] << ", not " << expected[row];
    }
    // The same for all rays: computed before them, as scalars.
    const auto once = compiled(of_op(op, types, Rate::frame, upward), target);
    for (std::size_t row = 0; row < size; row += arity == 1 ? 1 : 37) {
      std::vector<Column> values;
      for (const Column& column : columns) values.push_back({column[row]});
      ASSERT_TRUE(same(run(*once, values, 1)[0][0], expected[row]))
          << target.name << " scalar " << info(op).name;
    }
  }
}

// On numbers, with a builder.
std::vector<Op> ops_on_numbers() {
  std::vector<Op> ops;
  for (int i = 0; i < op_count; ++i) {
    const OpInfo& row = info(static_cast<Op>(i));
    const bool numbers =
        row.kind == OpKind::real || row.kind == OpKind::upward || row.kind == OpKind::compare;
    if (numbers && static_cast<Op>(i) != Op::powi) ops.push_back(static_cast<Op>(i));
  }
  return ops;
}

class LlvmOp : public testing::TestWithParam<Op> {};

TEST_P(LlvmOp, means_what_the_table_says) {
  const Op op = GetParam();
  for (const bool upward : {false, true}) {
    if (rounds_up(op) && !upward) continue;
    check_real<float>(op, f32, upward);
    check_real<double>(op, f64, upward);
  }
}

INSTANTIATE_TEST_SUITE_P(All, LlvmOp, testing::ValuesIn(ops_on_numbers()),
                         [](const auto& test) { return std::string(imp::info(test.param).name); });

TEST(LlvmOps, logic_and_choice) {
  const auto columns = tuples(2, {0, 1});
  Program program;
  program.name = "logic";
  const Id a = add_input(program, "a", truth, Rate::ray), b = add_input(program, "b", truth, Rate::ray);
  const Id x = add_input(program, "x", f64, Rate::frame), y = add_input(program, "y", f64, Rate::ray);
  Graph& graph = program.graph;
  const Id either = graph.add(Op::or_, {a, b}), both = graph.add(Op::and_, {a, b});
  program.outputs = {
      {"and", both},
      {"or", either},
      {"not", graph.add(Op::not_, {a})},
      {"select", graph.add(Op::select, {graph.add(Op::and_, {either, graph.add(Op::not_, {both})}), x, y})}};
  for (const CpuTarget& target : targets_here()) {
    const auto got = run(*compiled(program, target), {columns[0], columns[1], {2.5}, {1, 2, 3, 4}}, 4);
    EXPECT_EQ(got[0], (Column{0, 0, 0, 1}));
    EXPECT_EQ(got[1], (Column{0, 1, 1, 1}));
    EXPECT_EQ(got[2], (Column{1, 0, 1, 0}));
    EXPECT_EQ(got[3], (Column{1, 2.5, 2.5, 4}));
  }
}

TEST(LlvmOps, conversions) {
  for (const bool upward : {false, true}) {
    const auto doubles = interesting_values<double>();
    const Program narrow = of_op(upward ? Op::narrow_up : Op::narrow, std::array{f64}, Rate::ray, false);
    const Program widen = of_op(Op::widen, std::array{f32}, Rate::ray, false);
    Column expected;
    {
      const RoundingMode mode(upward ? FE_UPWARD : FE_TONEAREST);
      for (const double value : doubles) expected.push_back(static_cast<float>(value));
    }
    for (const CpuTarget& target : targets_here()) {
      expect_same(run(*compiled(narrow, target), {doubles}, doubles.size()), {expected},
                  target.name + " narrow");
      expect_same(run(*compiled(widen, target), {expected}, expected.size()), {expected},
                  target.name + " widen");
    }
  }
}

TEST(LlvmOps, any_and_all_speak_for_the_rays_of_a_packet) {
  Program program;
  program.name = "packet";
  const Id a = add_input(program, "a", truth, Rate::ray);
  program.outputs = {{"any", program.graph.add(Op::any, {a})}, {"all", program.graph.add(Op::all, {a})}};
  for (const CpuTarget& target : targets_here()) {
    const std::size_t lanes = target.lanes(program);
    const auto kernel = compiled(program, target);
    for (std::size_t size = 1; size <= 2 * lanes; ++size)
      for (const int density : {0, 1, 2, 3}) {
        Column values;
        for (std::size_t i = 0; i < size; ++i)
          values.push_back(density == 3 || (density != 0 && i % 5 == 3) || (density == 2 && i < lanes) ? 1
                                                                                                       : 0);
        std::vector<Column> expected(2);
        for (std::size_t i = 0; i < size; ++i) {
          const std::size_t first = i / lanes * lanes, last = std::min(first + lanes, size);
          const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first),
                     end = values.begin() + static_cast<std::ptrdiff_t>(last);
          expected[0].push_back(std::find(begin, end, 1) != end ? 1 : 0);
          expected[1].push_back(std::find(begin, end, 0) == end ? 1 : 0);
        }
        expect_same(run(*kernel, {values}, size), expected,
                    target.name + ", " + std::to_string(size) + " rays");
      }
  }
}

}  // namespace
}  // namespace imp
