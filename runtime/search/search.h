// Ray search: what a strategy is given, and what it answers.
//
// A ray is a segment p + s d with s in [0, 1] (Knoll et al. 2009, §5.5). A strategy is a function
// that builds its phases into a Program; it runs on every backend.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string_view>

#include "ir/program.h"
#include "passes/extend/interval_rules.h"

namespace imp {

// The same segment twice: as enclosures of the true one, and as the nearest numbers.
struct Segment {
  std::array<Interval, 3> origin_bounds, direction_bounds;
  std::array<Expr, 3> origin, direction;
  Truth exists;  // false: the ray has no such segment, and the answer is a miss
};

// f along the segment. Point values propose, enclosures decide.
struct RayFunction {
  std::function<Interval(const Interval& s)> bound;        // encloses f over the piece s
  std::function<Interval(const Interval& s)> slope_bound;  // encloses df/ds
  std::function<Expr(Expr s)> value;                       // f, rounded
  std::function<Expr(Expr s)> slope;                       // df/ds, rounded
  Expr like;                                               // any number of the kernel's type
  Truth exists;
};

struct SearchLimits {
  std::optional<double> epsilon;  // a piece of this share of the segment is no longer split
  std::uint32_t steps = 16384;    // a lane that takes more is undecided
};

// The share at which splitting a piece further tells nothing new in a kernel's arithmetic; the
// default, and the least there is.
constexpr double finest_epsilon(Type type) { return type == f32 ? 0x1p-22 : 0x1p-30; }

// What a search with these limits does not split further.
inline double epsilon_of(const SearchLimits& limits, Type type) {
  return std::max(finest_epsilon(type), limits.epsilon.value_or(finest_epsilon(type)));
}

// The longest piece, as a share of the segment, on which a sign change alone certifies a hit
// (where df/ds excludes 0, any length does).
inline constexpr double certified_length = 1e-5;

// Neighbouring pieces of length epsilon that may hold a root are taken together up to this length.
// Where the limit is hit one more piece may be in, so what is found lies within twice of it.
constexpr double longest_run(double epsilon) {
  return std::max({certified_length, 16 * epsilon, std::min(256 * epsilon, 1e-4)});
}

// The verdicts of a kernel, as numbers.
inline constexpr double verdict_hit = 1, verdict_miss = 0, verdict_undecided = -1;

struct Found {
  Expr verdict;
  Truth something;  // s holds a root, certified or not
  Expr s;
  Expr steps;  // evaluations of the inclusion
};

using Strategy = Found (*)(Program& program, const RayFunction& f, const SearchLimits& limits);

struct Search {
  std::string_view name;
  std::string_view summary;  // one line for `imp list searches`
  Strategy build;
};

// Every strategy, by name.
std::span<const Search> searches();
const Search* search_named(std::string_view name);

Found stackless(Program& program, const RayFunction& f, const SearchLimits& limits);

}  // namespace imp
