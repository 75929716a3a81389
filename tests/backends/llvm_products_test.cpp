// What is written for people and for linkers, what is refused, and kernels in many threads.
#include <elf.h>

#include <array>
#include <set>
#include <sstream>
#include <thread>

#include "tests/backends/llvm_support.h"

namespace imp {
namespace {

// Every op that has a builder, in a phase, f32 and f64, with a callee and tables of all kinds.
Program everything(bool upward) {
  Program callee;
  callee.name = "inner";
  const Id in = add_input(callee, "in", f32, Rate::ray);
  callee.outputs.push_back({"root", callee.graph.add(Op::sqrt, {in})});

  Program program;
  program.name = "every thing";  // not a name in C
  program.callees.push_back(std::make_shared<Program>(callee));
  Graph& graph = program.graph;
  for (const Type type : {f32, f64}) {
    const std::string suffix = type == f32 ? "f" : "d";
    const Id x = add_input(program, "x" + suffix, type, Rate::ray);
    const Id given = add_input(program, "given" + suffix, table_of(type, 20), Rate::cell);
    const auto number = static_cast<std::uint32_t>(program.phases.size());
    Phase phase;
    phase.name = "phase" + suffix;
    phase.steps = 9;
    phase.enter = phase.again = graph.constant(true);
    const Id t = graph.leaf(Op::state, type, pair_of(number, 0)),
             table = graph.leaf(Op::state, table_of(type, 20), pair_of(number, 1));
    Id sum = graph.add(Op::add, {t, graph.add(Op::load, {table, t})});
    for (int i = 0; i < op_count; ++i) {
      const Op op = static_cast<Op>(i);
      const OpInfo& row = info(op);
      if (row.llvm.empty() || takes_integers(op) || (rounds_up(op) && !upward)) continue;
      if (row.kind != OpKind::real && row.kind != OpKind::upward && row.kind != OpKind::compare) continue;
      const std::array args{sum, t, x};
      Id value = graph.add(op, std::span(args).first(static_cast<std::size_t>(row.arity)));
      if (row.kind == OpKind::compare) value = graph.add(Op::select, {graph.add(Op::any, {value}), t, x});
      sum = graph.add(Op::add, {sum, value});
    }
    if (type == f32) sum = graph.add(Op::add, {sum, graph.call(f32, 0, 0, std::array{sum})});
    phase.states = {
        {"t", type, t, graph.leaf(Op::result, type, pair_of(number, 0)), x, sum},
        {"table", table_of(type, 20), table, graph.leaf(Op::result, table_of(type, 20), pair_of(number, 1)),
         given, graph.add(Op::store, {table, t, sum})}};
    program.outputs.push_back({"t" + suffix, phase.states[0].result});
    program.phases.push_back(phase);
  }
  const Id narrow = graph.add(upward ? Op::narrow_up : Op::narrow, {program.outputs[1].id});
  program.outputs.push_back(
      {"wide", graph.add(Op::widen, {graph.add(Op::add, {narrow, program.outputs[0].id})})});
  graph.set_name(narrow, "narrowed");
  return program;
}

bool has(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

// Every call goes to a function of the same text.
void expect_own_calls_only(const std::string& assembly) {
  std::set<std::string> defined, called;
  std::istringstream lines(assembly);
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line[0] != '\t' && has(line, ":")) defined.insert(line.substr(0, line.find(':')));
    std::istringstream words(line);
    std::string first, second;
    words >> first >> second;
    if (first.starts_with("call")) called.insert(second.substr(0, second.find('@')));
  }
  for (const std::string& name : called) EXPECT_TRUE(defined.contains(name)) << "calls " << name;
  EXPECT_FALSE(called.empty());
}

TEST(LlvmProducts, assembly_for_every_target) {
  for (const bool upward : {false, true}) {
    const Program program = everything(upward);
    ASSERT_EQ(verify(program), "");
    for (const CpuTarget& target : cpu_targets()) {
      const auto text = emit(program, target, CodeForm::assembly);
      ASSERT_TRUE(text.has_value()) << text.error().message;
      expect_own_calls_only(*text);
      EXPECT_TRUE(has(*text, "imp_every_thing:")) << target.name;
      if (target.name == "host") continue;
      EXPECT_EQ(has(*text, "%zmm"), target.name == "avx512") << target.name;
      EXPECT_EQ(has(*text, "%ymm"), target.name != "sse4.1") << target.name;
      EXPECT_EQ(has(*text, "vmulp"), target.name != "sse4.1") << target.name;
      EXPECT_EQ(has(*text, "vfmadd") || has(*text, "vfnmadd"), target.name != "sse4.1") << target.name;
      EXPECT_TRUE(has(*text, target.name == "avx512" ? "vrndscaleps" : "roundps")) << target.name;
    }
  }
}

// Symbols that an object defines and those it wants, read from its ELF tables.
struct Symbols {
  std::set<std::string> global, undefined;
};

Symbols symbols_of(const std::string& object) {
  const auto read = [&]<class T>(std::size_t at, T value) {
    std::memcpy(&value, object.data() + at, sizeof value);
    return value;
  };
  const auto header = read(0, Elf64_Ehdr{});
  const auto section = [&](std::size_t i) {
    return read(header.e_shoff + i * header.e_shentsize, Elf64_Shdr{});
  };
  Symbols symbols;
  for (std::size_t i = 0; i < header.e_shnum; ++i) {
    const auto table = section(i);
    if (table.sh_type != SHT_SYMTAB) continue;
    const auto names = section(table.sh_link);
    for (std::size_t at = sizeof(Elf64_Sym); at < table.sh_size; at += sizeof(Elf64_Sym)) {
      const auto symbol = read(table.sh_offset + at, Elf64_Sym{});
      const std::string name = object.data() + names.sh_offset + symbol.st_name;
      if (symbol.st_shndx == SHN_UNDEF)
        symbols.undefined.insert(name);
      else if (ELF64_ST_BIND(symbol.st_info) == STB_GLOBAL)
        symbols.global.insert(name);
    }
  }
  return symbols;
}

TEST(LlvmProducts, an_object_needs_nothing_and_gives_the_kernel) {
  for (const CpuTarget& target : cpu_targets()) {
    const auto object = emit(everything(true), target, CodeForm::object);
    ASSERT_TRUE(object.has_value());
    const Symbols symbols = symbols_of(*object);
    EXPECT_EQ(symbols.global, (std::set<std::string>{"imp_every_thing"})) << target.name;
    EXPECT_EQ(symbols.undefined, std::set<std::string>{}) << target.name;
  }
}

TEST(LlvmProducts, text_keeps_the_names_of_the_author) {
  const std::string text = *emit(everything(true), *cpu_target("avx2"), CodeForm::llvm_ir);
  for (const char* name : {"%narrowed", "%xf", "phasef:", "@inner("}) EXPECT_TRUE(has(text, name)) << name;
  EXPECT_TRUE(has(text, "constrained.fmul.v8f32"));
  EXPECT_FALSE(has(text, "fmul <"));
  const std::string nearest = *emit(everything(false), *cpu_target("avx2"), CodeForm::llvm_ir);
  EXPECT_FALSE(has(nearest, "constrained"));
  EXPECT_FALSE(has(nearest, "fast"));
}

TEST(LlvmProducts, targets) {
  ASSERT_EQ(cpu_targets().size(), 4u);
  EXPECT_FALSE(cpu_target("sparc").has_value());
  const Program program = parsed("program p\n  input ray x: f32\n  output x = %x\nend\n");
  EXPECT_EQ(cpu_target("avx512")->lanes(program), 16u);
  EXPECT_EQ(cpu_target("avx2")->lanes(program), 8u);
  EXPECT_EQ(cpu_target("sse4.1")->lanes(program), 4u);
  const Program doubles = parsed("program p\n  input ray x: f64\n  %y = add %x 1\n  output y = %y\nend\n");
  EXPECT_EQ(cpu_target("avx2")->lanes(doubles), 4u);
  const Program outside = parsed(R"(
program outside
  input ray x: f64
  %n = narrow %x
  phase p 3
    state t: f32 = %n
    %u = add %t 1f
    next t = %u
    again true
  end
  output t = %p.t
end)");
  EXPECT_EQ(cpu_target("avx2")->lanes(outside), 8u) << "f64 is not computed with in a phase";
  expect_agreement(outside, {ramp(-3, 0.7)});
  const Program mixed = parsed(R"(
program mixed
  input ray x: f32
  phase p 3
    state t: f32 = %x
    %w = widen %t
    %u = add %w 1
    %n = narrow %u
    next t = %n
    again true
  end
  output t = %p.t
end)");
  EXPECT_EQ(cpu_target("avx2")->lanes(mixed), 8u) << "a double takes two registers";
  expect_agreement(mixed, {ramp(-3, 0.7)});
  const Program uniform = parsed(R"(
program uniform
  input frame a: f64
  input ray x: f32
  %n = narrow %a
  %y = add %x %n
  output y = %y
end)");
  EXPECT_EQ(cpu_target("avx2")->lanes(uniform), 8u) << "a frame's numbers fill no registers";
}

TEST(LlvmProducts, what_would_take_minutes_is_refused) {
  Program program{.name = "long"};
  const Id x = add_input(program, "x", f32, Rate::ray);
  Id sum = x;
  for (int i = 0; i < 20001; ++i) sum = program.graph.add(Op::add, {sum, x});
  program.outputs.push_back({"sum", sum});
  const auto kernel = compile(program, *cpu_target("host"));
  ASSERT_FALSE(kernel.has_value());
  EXPECT_EQ(kernel.error().message,
            "this takes 20001 operations, and a kernel has at most 20000; use --backend=interpreter");
}

TEST(LlvmProducts, a_refusal_has_the_place_of_the_op) {
  Program program{.name = "sine"};
  const Id x = add_input(program, "x", f32, Rate::ray);
  const Id sine = program.graph.add(Op::sin, {x});
  program.graph.set_span(sine, {0, 4, 10});
  program.outputs.push_back({"y", sine});
  EXPECT_EQ(compile(program, *cpu_target("host")).error().span, (Span{0, 4, 10}));
}

TEST(LlvmProducts, ops_without_a_kernel_form_are_refused_by_name) {
  const CpuTarget target = *cpu_target("host");
  const auto refused = [&](const std::string& text) {
    const auto kernel = compile(parsed(text), target);
    return kernel ? "compiled" : kernel.error().message;
  };
  EXPECT_EQ(refused("program p\n  input ray x: f32\n  %y = sin %x\n  output y = %y\nend\n"),
            "'sin' has no kernel form yet; use --backend=interpreter");
  EXPECT_EQ(refused("program q\n  input ray x: f32\n  %y = exp %x\n  output y = %y\nend\n"
                    "program p\n  calls q\n  input ray x: f32\n  %y = call q.y %x\n  output y = %y\nend\n"),
            "'exp' has no kernel form yet; use --backend=interpreter");
  EXPECT_EQ(refused("program p\n  input ray x: f32\n  %y = powi %x 3f\n  output y = %y\nend\n"),
            "'powi' has no kernel form: the power pass must expand it first");
  EXPECT_EQ(refused("program p\n  input ray x: f32\n  %t = fill f32[5000] %x\n  %u = store %t %x 1f\n  %y = "
                    "load %u %x\n  output y "
                    "= %y\nend\n"),
            "a table of 5000 values is too long for a kernel; 4096 is the most");
  EXPECT_EQ(refused("program p\n  input ray x: f32\n  %unused = sin %x\n  output x = %x\nend\n"), "compiled");

  CpuTarget foreign = target;
  foreign.name = "avx512";
  foreign.runs_here = false;
  EXPECT_EQ(compile(parsed("program p\n  input ray x: f32\n  output x = %x\nend\n"), foreign).error().message,
            "this processor cannot run code for 'avx512'");
}

TEST(LlvmProducts, kernels_compile_and_run_in_many_threads) {
  const Program program = parsed(R"(
program march
  input frame pace: f32
  input ray x: f32
  phase march 100
    state t: f32 = 0f
    %u = add %t %pace
    %far = lt %u %x
    next t = %u
    again %far
  end
  output t = %march.t
end)");
  const std::vector<Column> inputs{{0.5}, ramp(0, 0.6)};
  const auto expected = run(*interpret(program), inputs, 65);
  const auto shared = compiled(program, *cpu_target("host"));
  std::vector<std::jthread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      for (int k = 0; k < 5; ++k) {
        CompileTimes times;
        const auto own = compile(program, *cpu_target("host"), &times);
        ASSERT_TRUE(own.has_value());
        EXPECT_GT(times.build, 0);
        EXPECT_GT(times.codegen, 0);
        for (int n = 0; n < 20; ++n) {
          expect_same(run(**own, inputs, 65), expected, "own kernel");
          expect_same(run(*shared, inputs, 65), expected, "shared kernel");
        }
      }
    });
}

}  // namespace
}  // namespace imp
