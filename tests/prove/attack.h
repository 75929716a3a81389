// Certified answers about random formulas, held against proofs in ball arithmetic.
#pragma once

#include <cstdint>

namespace imp::prove {

struct AttackTableOptions {
  double minutes = 0;          // 0: as many rounds as are asked for
  std::uint64_t rounds = 200;  // files
  std::uint64_t seed = 1;
  std::size_t shrink = 300;  // tries to make shorter what is wrong
};

// Prints a table in Markdown, and each wrong answer on standard error, as a line for tests/data/attack.txt.
// False if there is one.
bool attack(const AttackTableOptions& options);

}  // namespace imp::prove
