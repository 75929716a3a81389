// Tests over every form of inclusion, and which formulas a form need not take.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "passes/extend/forms.h"
#include "passes/polynomial/degree.h"

namespace imp::test {

// The name of a test of one form, as GoogleTest wants it: mean_value.
inline std::string form_name(const testing::TestParamInfo<Inclusion>& test) {
  std::string name(test.param.name);
  std::ranges::replace(name, '-', '_');
  return name;
}

inline auto every_form() { return testing::ValuesIn(inclusions().begin(), inclusions().end()); }

// That of Bernstein is for polynomials in what changes from ray to ray, in space of low degree; every other
// form takes all there is.
inline bool may_refuse(const Inclusion& form, const Program& f) {
  if (form.enclose != bernstein_form) return false;
  std::vector<std::size_t> variables;
  for (std::size_t i = 0; i < f.inputs.size(); ++i)
    if (f.inputs[i].rate == Rate::ray) variables.push_back(i);
  Diagnostics unused;
  const auto all = degrees(f, variables, unused);
  return !all || std::ranges::any_of(*all, [](const Degree& degree) {
    std::uint64_t points = 1;
    for (const std::uint64_t n : degree.in) points *= std::min<std::uint64_t>(n, 400) + 1;
    return std::ranges::max(degree.in) > 32 || points > 343;
  });
}

}  // namespace imp::test
