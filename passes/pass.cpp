// Running passes: in order, timed, printed and verified.
#include "passes/pass.h"

#include <map>
#include <ostream>
#include <string>

#include "ir/assert.h"
#include "ir/text.h"
#include "ir/verify.h"
#include "passes/canonicalize.h"
#include "passes/chebyshev.h"
#include "passes/elementary/lower.h"
#include "passes/power.h"

namespace imp {
namespace {

constexpr Pass kernel[] = {
    {"elementary", Preserves::value, lower_elementary},
    {"chebyshev", Preserves::bits, reduce_chebyshev},
    {"powers", Preserves::bits, reduce_powers},
    {"canonicalize", Preserves::bits, canonicalize},
    {"dead-code", Preserves::bits, compact},
};

// Callees that are done, by what they were, so that what was shared stays shared.
using Done = std::map<std::shared_ptr<const Program>, std::shared_ptr<const Program>>;

void check([[maybe_unused]] const Program& program, [[maybe_unused]] const Pass& pass) {
#ifndef NDEBUG
  const std::string wrong = verify(program);
  const std::string expectation = "a legal Program after the pass '" + std::string(pass.name) + "': " + wrong;
  IMP_ASSERT(wrong.empty(), expectation.c_str());
#endif
}

Program run_one(const Program& program, const Pass& pass, PassTrace* trace) {
  const auto start = std::chrono::steady_clock::now();
  Program next = pass.run(program);
  const auto time = std::chrono::steady_clock::now() - start;
  check(next, pass);
  if (trace) {
    const bool changed = !(next == program);  // dead nodes and numbers aside
    trace->times.push_back({pass.name, time, program.graph.size(), next.graph.size(), changed});
    const bool wanted = trace->print_after.empty() ? changed : trace->print_after == pass.name;
    if (trace->text && wanted) *trace->text << "== " << pass.name << '\n' << to_text(next);
  }
  return next;
}

Program run(Program program, std::span<const Pass> passes, PassTrace* trace, Done& done) {
  for (auto& callee : program.callees) {
    auto& result = done[callee];
    if (!result) result = std::make_shared<const Program>(run(*callee, passes, trace, done));
    callee = result;
  }
  for (const Pass& pass : passes) program = run_one(program, pass, trace);
  return program;
}

}  // namespace

Program run_passes(Program program, std::span<const Pass> passes, PassTrace* trace) {
  Done done;
  return run(std::move(program), passes, trace, done);
}

std::span<const Pass> kernel_passes() { return kernel; }

}  // namespace imp
