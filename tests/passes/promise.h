// What passes promise of every Program. A Program of which one breaks its word is shrunk, and printed as text to be
// pasted into a test.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <ostream>

#include "ir/text.h"
#include "tests/support/random_program.h"

namespace imp::test {

struct Promise {
  const char* name;
  Program (*run)(const Program&);
};

inline void PrintTo(const Promise& promise, std::ostream* out) { *out << promise.name; }

class Promises : public testing::TestWithParam<Promise> {
 protected:
  void report(const char* what, std::uint64_t seed, const Program& p,
              const std::function<bool(const Program&)>& fails) {
    if (!fails(p)) return;
    const Program small = shrink(p, fails);
    ADD_FAILURE() << what << ", seed " << seed << '\n'
                  << to_text(small) << "becomes\n"
                  << to_text(GetParam().run(small));
  }
};

}  // namespace imp::test
