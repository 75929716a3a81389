// Short ways from a text to what it means.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <string_view>

#include "frontend/model.h"
#include "ir/text.h"
#include "ir/verify.h"
#include "tests/support/evaluate.h"

namespace imp::test {

// The Model of a text that is right.
inline Model parse(std::string_view text) {
  Diagnostics diagnostics;
  auto model = parse_model(std::string(text), "test.imp", diagnostics);
  EXPECT_TRUE(model.has_value()) << text << '\n' << to_text(diagnostics);
  EXPECT_TRUE(diagnostics.all().empty()) << to_text(diagnostics);
  if (!model) return parse("0");
  for (const Surface& surface : model->surfaces) EXPECT_EQ(verify(surface.f), "") << text;
  EXPECT_EQ(verify(model->settings), "") << text;
  return *std::move(model);
}

// f of the first surface.
inline Program surface(std::string_view text) { return parse(text).surfaces[0].f; }

// Its value at a point; parameters and time, if there are any, follow it.
inline double value(std::string_view text, std::initializer_list<double> inputs) {
  return evaluate(surface(text), inputs)[0];
}
inline double value(std::string_view text) { return value(text, {2, 3, 5}); }

// Its last node as text: what a piece of text became.
inline std::string root(std::string_view text) {
  const Program f = surface(text);
  const Node node = f.graph[f.outputs[0].id];
  std::string result(info(node.op).name);
  for (const Id arg : node.args) {
    const auto number = f.graph.number(arg);
    result += number ? fmt::format(" {}", *number) : fmt::format(" {}", info(f.graph[arg].op).name);
  }
  return result;
}

}  // namespace imp::test
