#include "backends/llvm/target.h"

#include <llvm/ADT/StringMap.h>
#include <llvm/TargetParser/Host.h>

#include <algorithm>

#include "ir/regions.h"

namespace imp {
namespace {

constexpr std::string_view avx512_needs[] = {"avx512f", "avx512bw", "avx512cd", "avx512dq", "avx512vl"};
constexpr std::string_view avx2_needs[] = {"avx2", "fma"};
constexpr std::string_view sse41_needs[] = {"sse4.1"};

class Host {
 public:
  Host() : features_(llvm::sys::getHostCPUFeatures()) {}

  bool has(std::span<const std::string_view> needs) const {
    return std::ranges::all_of(needs, [&](std::string_view name) { return features_.lookup(name); });
  }

  // Sorted, so that equal machines give equal text.
  std::string features() const {
    std::vector<std::string> names;
    for (const auto& feature : features_)
      names.push_back((feature.second ? '+' : '-') + feature.first().str());
    std::ranges::sort(names);
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ",") + name;
    return text;
  }

  unsigned register_bits() const { return has(avx512_needs) ? 512 : has(avx2_needs) ? 256 : 128; }

 private:
  llvm::StringMap<bool, llvm::MallocAllocator> features_;
};

// The widths of the numbers computed with.
struct Widths {
  bool floats = false, doubles = false;

  void see(Type type) {
    floats = floats || type.scalar == Scalar::f32;
    doubles = doubles || type.scalar == Scalar::f64;
  }
};

// Of what is computed for each ray.
void see_widths(const Program& program, bool called_in_a_phase, Widths& in_phases, Widths& at_all) {
  const auto region = regions(program);
  for (const auto& nodes : schedule(program))
    for (const Id id : nodes) {
      const Node node = program.graph[id];
      if (region[id.index] < Region::of(Rate::ray)) continue;
      const bool inside = called_in_a_phase || region[id.index].inside_a_phase();
      const auto see = [&](Type type) {
        at_all.see(type);
        if (inside) in_phases.see(type);
      };
      see(node.type);
      for (const Id arg : node.args) see(program.graph[arg].type);
      if (node.op == Op::call) see_widths(*program.callees[node.high()], inside, in_phases, at_all);
    }
}

}  // namespace

unsigned CpuTarget::lanes(const Program& program) const {
  Widths in_phases, at_all;
  see_widths(program, false, in_phases, at_all);
  const bool by_floats = in_phases.floats || (!in_phases.doubles && !at_all.doubles);
  return packet_registers * register_bits / (by_floats ? 32 : 64);
}

std::vector<CpuTarget> cpu_targets() {
  const Host host;
  return {
      {"host", llvm::sys::getHostCPUName().str(), host.features(), host.register_bits(),
       host.has(sse41_needs)},
      {"avx512", "x86-64-v4", "", 512, host.has(avx512_needs)},
      {"avx2", "x86-64-v3", "", 256, host.has(avx2_needs)},
      {"sse4.1", "x86-64", "+sse4.1", 128, host.has(sse41_needs)},
  };
}

std::optional<CpuTarget> cpu_target(std::string_view name) {
  for (CpuTarget& target : cpu_targets())
    if (target.name == name) return std::move(target);
  return std::nullopt;
}

}  // namespace imp
