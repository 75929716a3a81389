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
#include <vector>

#include "ir/diagnostics.h"
#include "ir/program.h"
#include "passes/extend/interval_rules.h"

namespace imp {

// The same segment as enclosures of the true one, in the kernel's type and in f64, and as the nearest numbers.
struct Segment {
  std::array<Interval, 3> origin_bounds, direction_bounds;
  std::array<Interval, 3> wide_origin_bounds, wide_direction_bounds;  // in f64
  std::array<Expr, 3> origin, direction;
  Truth exists;  // false: the ray has no such segment, and the answer is a miss
};

struct RayDegree {
  std::uint32_t degree;
  Span span;  // of f in the text
};

// f along the segment. Point values propose, enclosures decide.
struct RayFunction {
  std::function<Interval(const Interval& s)> bound;        // encloses f over the piece s
  std::function<Interval(const Interval& s)> slope_bound;  // encloses df/ds
  std::function<Interval(Expr s)> bound_at;                // encloses f at one place: as tight, for less
  std::function<Interval(Expr s)> bound_in_double;         // the same in f64, whatever the type of s
  std::function<Expr(Expr s)> value;                       // f, rounded
  std::function<Expr(Expr s)> slope;                       // df/ds, rounded
  std::function<Expr(Expr s)> value_in_double;             // f in f64, whatever the type of s
  Expr like;                                               // any number of the kernel's type
  Truth exists;
  Truth certain;  // false: the segment leaves the space in which bounds hold, and nothing is proven

  // Where f is a polynomial in x, y, z: its degree in s at most, and enclosures of its coefficients in Bernstein
  // form over the piece s, in the type of its ends. Errors point at what makes f none, or say that it has too many
  // coefficients. Where one coefficient is empty, f is defined nowhere on the ray.
  std::function<std::optional<RayDegree>(Diagnostics&)> degree{};
  std::function<std::optional<std::vector<Interval>>(const Interval& s, Diagnostics&)> coefficients{};
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

// A piece [a, b] of the ray. If `changes`, f has the sign `sign_a` at a and the other one at b.
struct Bracket {
  Expr a, b;
  Expr sign_a;
  Truth changes;
};

struct Found {
  Expr verdict;
  Truth something;  // there may be a root, certified or not,
  Bracket bracket;  // in here: to be refined
  Expr steps;       // evaluations of the inclusion
};

// Errors say why the strategy is not for this f, and what is.
using Strategy = std::optional<Found> (*)(Program& program, const RayFunction& f, const SearchLimits& limits,
                                          Diagnostics& diagnostics);

struct Search {
  std::string_view name;
  std::string_view summary;  // one line for `imp list searches`
  Strategy build;
  bool by_coefficients = false;  // of a polynomial: whatever the inclusion
};

// Every strategy, by name.
std::span<const Search> searches();
const Search* search_named(std::string_view name);

std::optional<Found> stackless(Program& program, const RayFunction& f, const SearchLimits& limits,
                               Diagnostics& diagnostics);
std::optional<Found> isolate(Program& program, const RayFunction& f, const SearchLimits& limits,
                             Diagnostics& diagnostics);
std::optional<Found> segment_tracing(Program& program, const RayFunction& f, const SearchLimits& limits,
                                     Diagnostics& diagnostics);
std::optional<Found> newton(Program& program, const RayFunction& f, const SearchLimits& limits,
                            Diagnostics& diagnostics);
std::optional<Found> polynomial(Program& program, const RayFunction& f, const SearchLimits& limits,
                                Diagnostics& diagnostics);
std::optional<Found> bernstein(Program& program, const RayFunction& f, const SearchLimits& limits,
                               Diagnostics& diagnostics);

}  // namespace imp
