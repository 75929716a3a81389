// A Program: everything that runs. Named inputs, a graph, at most a few phases, named outputs.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ir/graph.h"

namespace imp {

// How often an input changes: never within a frame (a uniform), a cell of a grid, or a ray.
enum class Rate : std::uint8_t { frame, cell, ray };

struct Input {
  std::string name;
  Type type;  // may be a table: read-only, loaded with Op::load
  Rate rate;
  Id id;
};

struct Output {
  std::string name;
  Id id;
};

// One variable of a phase. Inside the phase `id` is its current value; after it `result` is the
// last one.
struct State {
  std::string name;
  Type type;
  Id id, result;
  Id init;  // evaluated before the phase
  Id next;  // evaluated inside it
};

// A loop. A lane enters if `enter`; a step computes every `next` from the current states, all at
// once, and the lane goes on while `again` holds (computed from the states before the step) and
// fewer than `steps` steps were made. Lanes that are done keep their state.
struct Phase {
  std::string name;
  std::vector<State> states;
  Id enter;
  Id again;
  std::uint32_t steps = 0;
};

struct Program {
  std::string name{};
  Graph graph{};
  std::vector<Input> inputs{};
  std::vector<Phase> phases{};  // run in this order
  std::vector<Output> outputs{};
  std::vector<std::shared_ptr<const Program>> callees{};  // of Op::call; run under the active mask

  const Output* output(std::string_view name) const;
  const Input* input(std::string_view name) const;
};

// Adds an input, and its leaf to the graph.
Id add_input(Program& program, std::string name, Type type, Rate rate);

// True if the Program or one it calls holds an upward op: it then runs rounding upward.
bool rounds_up(const Program& program);

// Without what no output needs, renumbered: by region (ir/regions.h), and within one as the outputs
// reach the nodes, in whatever order they were built. The inputs stay.
Program compact(const Program& program);

// Equal up to dead nodes and numbering.
bool operator==(const Program& a, const Program& b);

}  // namespace imp
