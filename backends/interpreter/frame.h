// One run of a Program, one ray at a time: the value of every node.
#pragma once

#include <bit>
#include <functional>
#include <memory>
#include <vector>

#include "backends/interpreter/plan.h"

namespace imp {

class Frame {
 public:
  // Told of a phase before each step, and once more when it is over (again: the step is taken).
  using Watch = std::function<void(std::size_t phase, std::uint32_t step, bool again)>;

  explicit Frame(const Plan& plan);

  // The value of a node as bits: a float in the low half, a truth as 0 or 1. A table has many values,
  // anything else one.
  std::uint64_t bits(Id id) const { return values_[id.index]; }
  void set_bits(Id id, std::uint64_t bits) { values_[id.index] = bits; }
  std::span<const std::uint64_t> all_bits(Id id) const;
  std::span<std::uint64_t> all_bits(Id id);

  // The nodes of all cells, and those of one ray, which come after.
  void run_shared();
  void run_ray(const Watch& watch = {});

 private:
  template <class T>
  T number(Id id) const;
  void set(Id id, float value) { set_bits(id, std::bit_cast<std::uint32_t>(value)); }
  void set(Id id, double value) { set_bits(id, std::bit_cast<std::uint64_t>(value)); }
  void set(Id id, bool value) { set_bits(id, value); }

  void copy(const Frame& source, Id from, Id to);

  void evaluate(Region region);
  void evaluate(Id id);
  template <class T>
  void evaluate_real(Id id, const Node& node);
  template <class T>
  void evaluate_compare(Id id, const Node& node);
  void evaluate_convert(Id id, const Node& node);
  void evaluate_table(Id id, const Node& node);
  std::size_t index(Id id, std::size_t length) const;  // of an element: rounded down and clamped, NaN is 0
  void call(Id id, const Node& node);

  void run_phase(std::size_t i, const Watch& watch);
  void take_step(const Phase& phase);

  const Plan& plan_;
  const Graph& graph_;
  std::vector<std::uint64_t> values_;  // by node; of a table, its place in tables_
  std::vector<std::uint64_t> tables_;
  std::vector<std::uint64_t> next_;  // the states of a phase after the current step
  std::vector<std::unique_ptr<Frame>> callees_;
};

}  // namespace imp
