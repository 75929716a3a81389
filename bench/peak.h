// What this machine can do at most: the yardstick for figures from other machines.
#pragma once

namespace imp::bench {

// 10^9 floating-point operations a second of one thread in fused multiply-adds on its widest registers
// (a multiply-add is two); measured now, in about 20 ms.
double peak_gflops();

}  // namespace imp::bench
