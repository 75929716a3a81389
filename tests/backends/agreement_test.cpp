// Every op of ir/ops.def means on every backend what the last column says, bit for bit. A new op is tested
// by having a row. Shaders may do two things otherwise: an upward op may give more than the least number
// (backends/glsl/prelude.h), and plain ops round to nearest whatever is beside them. How many results of each
// target were compared is recorded, for the table of tools/dev prove conformance.
#include <algorithm>
#include <cfenv>
#include <functional>
#include <span>

#include "ir/meaning.h"
#include "ir/rounding.h"
#include "tests/backends/llvm_support.h"
#include "tests/support/interesting_values.h"
#include "tests/support/shader.h"

namespace imp {
namespace {

struct Runner {
  std::string name;
  std::function<std::unique_ptr<Kernel>(const Program&)> compile;
  bool fuses = true;
  bool is_shader = false;
  bool one_ray_a_packet = true;
  bool has_elementary = false;
};

std::vector<Runner> runners() {
  std::vector<Runner> all{{.name = "interpreter",
                           .compile = [](const Program& program) { return interpret(program); },
                           .has_elementary = true}};
  for (const CpuTarget& target : targets_here())
    all.push_back({.name = target.name,
                   .compile = [target](const Program& program) { return compiled(program, target); },
                   .fuses = target.register_bits > 128,
                   .one_ray_a_packet = false});
  if (GlContext::get())
    all.push_back({.name = "glsl", .compile = test::shader_of, .fuses = false, .is_shader = true});
  return all;
}

bool runs(const Runner& runner, Op op) {
  const OpKind kind = info(op).kind;
  return (kind != OpKind::elementary || runner.has_elementary) &&
         (kind != OpKind::packet || runner.one_ray_a_packet);  // of packets see llvm_ops_test.cpp
}

// The operands of `op` where its numbers are of type `real`; nothing where it is not for that type.
std::vector<Type> operand_types(Op op, Type real) {
  const OpInfo& row = info(op);
  std::vector<Type> types(static_cast<std::size_t>(row.arity), real);
  if (row.kind == OpKind::logic || row.kind == OpKind::packet) types.assign(types.size(), truth);
  if (row.kind == OpKind::choice) types[0] = truth;
  return type_of(op, types) ? types : std::vector<Type>{};
}

template <class T>
Column few_values() {
  using Limits = std::numeric_limits<T>;
  return {0.0,
          -0.0,
          1,
          -1,
          3,
          T(-0.1),
          T(1e30),
          T(-1e30),
          T(1e-30),
          Limits::min(),
          -Limits::denorm_min(),
          7.5,
          1 + Limits::epsilon(),
          T(1) / 3,
          Limits::max(),
          INFINITY,
          -INFINITY,
          NAN};
}

template <class T>
Column values_of(Type type, std::size_t arity) {
  if (type.is_truth()) return {0, 1};
  if (arity < 3) {
    const auto values = test::interesting_values<T>();
    return {values.begin(), values.end()};
  }
  return few_values<T>();
}

// All tuples of operands, one column an operand.
template <class T>
std::vector<Column> tuples(std::span<const Type> types) {
  std::vector<Column> columns(types.size()), choices;
  std::size_t count = 1;
  for (const Type type : types) count *= choices.emplace_back(values_of<T>(type, types.size())).size();
  for (std::size_t row = 0; row < count; ++row) {
    std::size_t rest = row;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      columns[i].push_back(choices[i][rest % choices[i].size()]);
      rest /= choices[i].size();
    }
  }
  return columns;
}

// In the rounding mode that is set.
template <class T>
double meaning_of(Op op, bool fuses, std::span<const double> args) {
  const auto at = [&](std::size_t i) { return i < args.size() ? args[i] : 0.0; };
  const auto x = static_cast<T>(at(0)), y = static_cast<T>(at(1)), z = static_cast<T>(at(2));
  switch (info(op).kind) {
    case OpKind::compare: return meaning::truth<T>(op, x, y) ? 1 : 0;
    case OpKind::logic:   return meaning::truth<bool>(op, at(0) != 0, at(1) != 0) ? 1 : 0;
    case OpKind::choice:  return at(0) != 0 ? y : z;
    case OpKind::packet:  return at(0);
    case OpKind::convert: return op == Op::widen ? at(0) : static_cast<double>(static_cast<float>(at(0)));
    default:              break;
  }
  if ((op == Op::fma || op == Op::fma_up) && !fuses) {
    const volatile T product = x * y;
    return product + z;
  }
  return meaning::real<T>(op, x, y, z);
}

// As much as a shader may go above `least`.
template <class T>
double raised(double least) {
  using Limits = std::numeric_limits<T>;
  const T finite = std::max(static_cast<T>(least), Limits::lowest());
  return std::nextafter(finite, INFINITY) + 2 * Limits::min();
}

template <class T>
bool is_denormal(double value) {
  return std::fpclassify(static_cast<T>(value)) == FP_SUBNORMAL;
}

// The op in a Program that rounds upward or does not, with all operands given.
class Case {
 public:
  Case(Op op, bool upward, const Runner& runner) : op_(op), upward_(upward), runner_(runner) {}

  // The program over `inputs`, of which `args` are the operands.
  static void add(Program& program, Op op, std::span<const Id> args, const std::string& name) {
    program.outputs.push_back({name, program.graph.add(op, args)});
  }
  Program program(std::span<const Type> types, Rate rate) const {
    Program result;
    result.name = info(op_).name;
    std::vector<Id> args;
    for (const Type type : types)
      args.push_back(add_input(result, std::string(1, static_cast<char>('a' + args.size())), type, rate));
    add(result, op_, args, "result");
    make_upward(result);
    return result;
  }
  void make_upward(Program& program) const {
    if (!upward_ || rounds_up(op_)) return;
    const Id four = add_input(program, "four", f32, Rate::frame);
    program.outputs.push_back({"upward", program.graph.add(Op::add_up, {four, four})});
  }
  // The values of the inputs, with that of `make_upward`.
  std::vector<Column> inputs(std::vector<Column> operands) const {
    if (upward_ && !rounds_up(op_)) operands.push_back({4});
    return operands;
  }

  template <class T>
  ::testing::AssertionResult is_right(double got, std::span<const double> args) const {
    const bool shader_goes_its_way = runner_.is_shader && !rounds_up(op_);
    const RoundingMode mode(upward_ && !shader_goes_its_way ? FE_UPWARD : FE_TONEAREST);
    const double least =
        runner_.is_shader ? least_in_a_shader<T>(args) : meaning_of<T>(op_, runner_.fuses, args);
    bool right = same(got, least) || (rounds_up(op_) && got == least);  // a zero of either sign
    if (runner_.is_shader && rounds_up(op_) && !right) {
      if (op_ ==
          Op::fma_up)  // of infinities, which are raised between its two ops, inf and NaN exclude nothing
        right = got >= least || (!std::isfinite(least) && !(got < INFINITY));
      else
        right = got >= least && got <= (op_ == Op::narrow_up ? raised<float>(least) : raised<T>(least));
    }
    if (runner_.is_shader && rounds_up(op_) && std::ranges::none_of(args, is_denormal<T>))
      right = right && !(op_ == Op::narrow_up ? is_denormal<float>(got) : is_denormal<T>(got));
    if (right) return ::testing::AssertionSuccess();
    const RoundingMode for_printing(FE_TONEAREST);
    return ::testing::AssertionFailure() << runner_.name << (upward_ ? " upward " : " ") << info(op_).name
                                         << testing::PrintToString(std::vector(args.begin(), args.end()))
                                         << ": " << got << ", not " << least;
  }

 private:
  // 0 times what is not finite is 0 there, and what is divided by 0 infinite, when it is rounded upward.
  template <class T>
  double least_in_a_shader(std::span<const double> args) const {
    const bool has_zero = args.size() > 1 && (args[0] == 0 || args[1] == 0);
    if (op_ == Op::mul_up && has_zero) return 0;
    if (op_ == Op::fma_up && has_zero) return static_cast<T>(args[2]);
    if (op_ == Op::div_up && args[1] == 0) return INFINITY;
    return meaning_of<T>(op_, runner_.fuses, args);
  }

  Op op_;
  bool upward_;
  const Runner& runner_;
};

std::vector<double> row_of(const std::vector<Column>& columns, std::size_t row) {
  std::vector<double> args;
  for (const Column& column : columns) args.push_back(column[row]);
  return args;
}

template <class T>
void check(Op op, Type real, bool upward, const Runner& runner, int& compared) {
  const std::vector<Type> types = operand_types(op, real);
  if (types.empty()) return;
  const Case one(op, upward, runner);
  const auto operands = tuples<T>(types);
  const std::size_t size = operands[0].size();
  const auto got = run(*runner.compile(one.program(types, Rate::ray)), one.inputs(operands), size);
  for (std::size_t row = 0; row < size; ++row)
    ASSERT_TRUE(one.is_right<T>(got[0][row], row_of(operands, row)));
  compared += static_cast<int>(size);

  // The same for all rays, where it may be computed before them.
  const auto once = runner.compile(one.program(types, Rate::frame));
  for (std::size_t row = 0; row < size; row += size > 100 ? 37 : 1) {
    std::vector<Column> values;
    for (const double value : row_of(operands, row)) values.push_back({value});
    ASSERT_TRUE(one.is_right<T>(run(*once, one.inputs(values), 1)[0][0], row_of(operands, row))) << "once";
  }
}

// One operand is a constant, which compilers may fold into the op.
template <class T>
void check_constants(Op op, Type real, bool upward, const Runner& runner, int& compared) {
  const std::vector<Type> types = operand_types(op, real);
  if (types.size() != 2 || types[0] != real) return;
  const Case one(op, upward, runner);
  const Column values = few_values<T>();
  Program program;
  program.name = info(op).name;
  const Id a = add_input(program, "a", real, Rate::ray);
  for (const double value : values) {
    const Id constant = program.graph.constant(real, value);
    Case::add(program, op, std::array{a, constant}, "of_constant" + std::to_string(program.outputs.size()));
    Case::add(program, op, std::array{constant, a}, "constant_of" + std::to_string(program.outputs.size()));
  }
  one.make_upward(program);
  const auto got = run(*runner.compile(program), one.inputs({values}), values.size());
  compared += static_cast<int>(2 * values.size() * values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    for (std::size_t row = 0; row < values.size(); ++row) {
      ASSERT_TRUE(one.is_right<T>(got[2 * i][row], std::array{values[row], values[i]}))
          << "constant " << values[i];
      ASSERT_TRUE(one.is_right<T>(got[2 * i + 1][row], std::array{values[i], values[row]}))
          << "constant " << values[i];
    }
}

std::vector<Op> computed_ops() {
  std::vector<Op> ops;
  for (int i = 0; i < op_count; ++i)
    if (const Op op = static_cast<Op>(i); info(op).kind != OpKind::structure && !takes_integers(op))
      ops.push_back(op);
  return ops;
}

class Agreement : public testing::TestWithParam<Op> {};

TEST_P(Agreement, an_op_means_the_same_everywhere) {
  const Op op = GetParam();
  for (const Runner& runner : runners()) {
    int compared = 0;
    for (const bool upward : {false, true}) {
      if ((rounds_up(op) && !upward) || !runs(runner, op)) continue;
      if (info(op).kind == OpKind::elementary && upward) continue;  // libm promises nothing there
      ASSERT_NO_FATAL_FAILURE(check<float>(op, f32, upward, runner, compared)) << "f32";
      ASSERT_NO_FATAL_FAILURE(check<double>(op, f64, upward, runner, compared)) << "f64";
      ASSERT_NO_FATAL_FAILURE(check_constants<float>(op, f32, upward, runner, compared)) << "f32";
      ASSERT_NO_FATAL_FAILURE(check_constants<double>(op, f64, upward, runner, compared)) << "f64";
    }
    RecordProperty(runner.name, compared);
  }
}

INSTANTIATE_TEST_SUITE_P(Ops, Agreement, testing::ValuesIn(computed_ops()),
                         [](const auto& test) { return std::string(imp::info(test.param).name); });

TEST(AgreementOfShaders, is_tested) { IMP_NEEDS_GL(); }  // else says why it is not

}  // namespace
}  // namespace imp
