// What this machine can do at most: the yardstick for figures from other machines.
#pragma once

namespace imp::bench {

// 10^9 floating-point operations a second of one thread in fused multiply-adds (a multiply-add is two) on registers of
// 512 bits, where the machine has them and it is asked for them, or 256; 0 where it has neither. Measured now, in about 20 ms.
double peak_gflops(bool widest = true);

// Operations a cycle at that peak, on processors of today.
double peak_a_cycle();

}  // namespace imp::bench
