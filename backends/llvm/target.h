// The processors that the LLVM backend emits code for, by name.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ir/program.h"

namespace imp {

struct CpuTarget {
  std::string name;      // host, avx512, avx2, sse4.1
  std::string cpu;       // LLVM's name of it: x86-64-v4, x86-64-v3, …; host: the host's own
  std::string features;  // "+avx2,+fma,…"
  unsigned register_bits = 128;
  bool runs_here = false;
  unsigned packet_registers = 1;  // that a number of a packet fills (docs/decisions/packets.md)

  // Rays a packet holds: that many registers of floats if the Program computes with floats in a phase (doubles
  // beside them take twice as many), else of the widest numbers it computes with for each ray.
  unsigned lanes(const Program& program) const;
};

std::vector<CpuTarget> cpu_targets();
std::optional<CpuTarget> cpu_target(std::string_view name);

}  // namespace imp
